#include "host/page/calls/calibrate.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/analysis/export.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/scan_figures.hpp"
#include "host/import/drives/drive_report.hpp"
#include "host/import/drives/stated_drives.hpp"
#include "host/import/drives/unused_choice.hpp"
#include "host/import/scans/scanned_drives.hpp"
#include "host/page/calls/question.hpp"
#include "host/page/calls/statements.hpp"
#include "host/report/report.hpp"

namespace astro::page {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Where the results stand in a folder.
struct Results {
  fs::path in, toml = in / "calib.toml", ros2 = in / "diff_drive_controller.yaml",
               report = in / "report.html";
};
const Results& results() {
  static const Results all{fs::path(kMade) / "results"};
  return all;
}

json sentences_of(const std::vector<Remark>& remarks) {
  json sentences = json::array();
  for (const Remark& remark : remarks) sentences.push_back(remark.sentence);
  return sentences;
}

json drives_of(const importing::ImportedDrives& imported) {
  json drives = json::array();
  for (std::size_t i = 0; i < imported.reports.size(); ++i) {
    drives.push_back({{"name", imported.set.names[i]},
                      {"summary", imported.reports[i].summary},
                      {"remarks", sentences_of(imported.reports[i].remarks)}});
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
  const experiment::ParameterFile file = experiment::read_parameter_file(folder / results().toml);
  experiment::require_loadable(file);
  const experiment::DiffDrive parameters = experiment::diff_drive(file, {});
  write_text(folder / results().ros2, experiment::ros2_yaml(file, parameters, "diff_drive_controller"));
  const auto note = experiment::single_wheelbase(file, parameters);
  return {{"ros2", results().ros2.string()}, {"not_in_ros2", note ? json(note->sentence) : json()}};
} catch (const Error& error) {
  return {{"ros2", nullptr}, {"not_in_ros2", error.what()}};
}

bool truth_is_scans(const importing::StatedDrives& stated) {
  const auto scans = std::ranges::count_if(
      stated.truth, [&](const fs::path& path) { return importing::gives_scans(path, stated); });
  if (scans != 0 && scans != std::ssize(stated.truth))
    throw Error(
        "only some drives have scans for ground truth, and these cannot be calibrated with the others: leave "
        "one kind out");
  return scans != 0;
}

json answer_of(const experiment::Calibration& found, const json& drives, const json& remarks,
               const fs::path& folder) {
  experiment::write_calibration(folder / results().toml, found);
  return {{"calibration", experiment::to_json(found)},
          {"drives", drives},
          {"remarks", remarks},
          {"verdict", experiment::judgement_sentence(found)},
          {"advises_against", experiment::advises_against(found.judgement.verdict)},
          {"report", results().report.string()}};
}

json by_scans(const importing::StatedDrives& stated, const std::string& scan_topic, const fs::path& folder) {
  const std::vector<importing::DriveFiles> files = importing::drive_files(stated);
  importing::refuse_choices_unused_with_scans(stated);
  const importing::ScannedDrives drives =
      importing::scanned_drives(files, importing::choices_of(stated), scan_topic);
  const bool mirrored = stated.mirrored == "yes";
  const lidar::ScanCalibration by_scans = lidar::calibrate_by_scans(drives.drives, drives.loaded, mirrored);
  std::vector<Remark> remarks = drives.remarks;
  remarks.insert(remarks.end(), by_scans.remarks.begin(), by_scans.remarks.end());
  experiment::Calibration found = experiment::calibration_of(by_scans);
  found.wheel = drives.wheel;
  report::write_report(folder / results().report, experiment::scan_report(found, drives.drives, mirrored));
  return answer_of(found, json::array(), sentences_of(remarks), folder);
}

json by_tracker(const importing::StatedDrives& stated, const fs::path& folder, const Emit& emit) {
  const importing::ImportedDrives imported = importing::import_stated(stated);
  const json drives = drives_of(imported);
  emit({{"event", "imported"}, {"drives", drives}});
  const experiment::Calibration found =
      experiment::calibrate(imported.set, {experiment::MethodChoice::Family::ml, {}});
  report::write_report(folder / results().report, importing::drive_report(imported.set, found));
  return answer_of(found, drives, json::array(), folder);
}

}  // namespace

json calibrate(const json& question, const fs::path& folder, const Emit& emit) {
  const importing::StatedDrives stated = statements_in(question, folder);
  if (stated.wheels.empty()) throw Error("there are no drives: give files of wheels and of ground truth");
  fs::create_directories(folder / results().in);
  json answer = truth_is_scans(stated) ? by_scans(stated, text_in(question, kScanTopic), folder)
                                       : by_tracker(stated, folder, emit);
  answer["toml"] = results().toml.string();
  answer.update(export_ros2(folder));
  return answer;
}

}  // namespace astro::page
