#include "host/page/calls/calibrate.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/analysis/export.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/import/drives/drive_report.hpp"
#include "host/import/drives/stated_drives.hpp"
#include "host/page/calls/statements.hpp"
#include "host/report/report.hpp"

namespace astro::page {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// In a folder of their own, so that no file of a person is written over, such as a calib.toml with the robot's sizes.
constexpr const char *kResults = "results", *kToml = "results/calib.toml",
                     *kRos2 = "results/diff_drive_controller.yaml", *kReport = "results/report.html";

json drives_of(const importing::ImportedDrives& imported) {
  json drives = json::array();
  for (std::size_t i = 0; i < imported.reports.size(); ++i) {
    json remarks = json::array();
    for (const Remark& remark : imported.reports[i].remarks) remarks.push_back(remark.sentence);
    drives.push_back(
        {{"name", imported.set.names[i]}, {"summary", imported.reports[i].summary}, {"remarks", remarks}});
  }
  return drives;
}

void write_text(const fs::path& path, const std::string& text) {
  PartFile file(path);
  file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  file.commit();
}

/// Writes the parameters of diff_drive_controller if the calibration has what it takes; {file, what to know of it}.
json export_ros2(const fs::path& folder) try {
  const experiment::ParameterFile file = experiment::read_parameter_file(folder / kToml);
  experiment::require_loadable(file);
  const experiment::DiffDrive parameters = experiment::diff_drive(file, {});
  write_text(folder / kRos2, experiment::ros2_yaml(file, parameters, "diff_drive_controller"));
  const auto note = experiment::single_wheelbase(file, parameters);
  return {{"ros2", kRos2}, {"not_in_ros2", note ? json(note->sentence) : json()}};
} catch (const Error& error) {
  return {{"ros2", nullptr}, {"not_in_ros2", error.what()}};
}

}  // namespace

json calibrate(const json& question, const fs::path& folder, const Emit& emit) {
  const importing::StatedDrives stated = statements_in(question, folder);
  if (stated.wheels.empty()) throw Error("there are no drives: give files of wheels and of ground truth");
  const importing::ImportedDrives imported = importing::import_stated(stated);
  const json drives = drives_of(imported);
  emit({{"event", "imported"}, {"drives", drives}});
  const experiment::Calibration found =
      experiment::calibrate(imported.set, {experiment::MethodChoice::Family::ml, {}});
  fs::create_directories(folder / kResults);
  experiment::write_calibration(folder / kToml, found);
  report::write_report(folder / kReport, importing::drive_report(imported.set, found));
  json answer = {{"calibration", experiment::to_json(found)},
                 {"drives", drives},
                 {"verdict", experiment::judgement_sentence(found.judgement)},
                 {"advises_against", experiment::advises_against(found.judgement.verdict)},
                 {"toml", kToml},
                 {"report", kReport}};
  answer.update(export_ros2(folder));
  return answer;
}

}  // namespace astro::page
