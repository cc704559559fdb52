#include "host/commands/calibrate/scan_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/commands/base/advice.hpp"
#include "host/commands/calibrate/scan_text.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/commands/shared/option_words.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/program.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/import/scans/carmen_log.hpp"
#include "host/import/scans/scan_result.hpp"
#include "host/import/scans/scanned_drives.hpp"
#include "host/lidar/scan_calibration.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "scan:";

constexpr Advice kScanAdvice[] = {
    {lidar::ScanProblem::mirrored,
     "; give --truth-mirrored yes if it is the scans, --swap-wheels if it is the wheels"},
    {lidar::ScanProblem::not_mirrored,
     "; leave out --truth-mirrored yes, or give --swap-wheels if left and right are exchanged as well"},
    {importing::ScanFileProblem::topic_unclear, ": name one with --scan-topic"},
    {importing::ScanFileProblem::no_topics, ": leave out --scan-topic"},
    {importing::ScanFileProblem::wheels_of_other_file, ": give the same file as --wheels"}};

std::optional<fs::path> scans_named(const fs::path& word) {
  const std::string& text = word.native();
  if (!text.starts_with(kPrefix) || text.size() == kPrefix.size()) return std::nullopt;
  return fs::path(text.substr(kPrefix.size()));
}

std::vector<importing::DriveFiles> files_of(const ImportOptions& options) {
  if (options.wheels.size() != options.truth.size())
    throw console::WrongUsage(fmt::format("there are {} --wheels and {} --truth: each drive needs both",
                                          options.wheels.size(), options.truth.size()));
  if (options.session_per_folder) throw console::WrongUsage("--session-per-folder does not apply to scans");
  require_film_for(options.film_figures, false);
  std::vector<importing::DriveFiles> files;
  for (std::size_t i = 0; i < options.truth.size(); ++i) {
    const auto scans = scans_named(options.truth[i]);
    if (!scans)
      throw console::WrongUsage(
          "scans and other files of ground truth cannot be mixed: give all --truth as scan:FILE, or none");
    files.push_back({options.wheels[i], *scans});
  }
  return files;
}

void refuse_unused(const ImportOptions& options, const std::vector<importing::DriveFiles>& files) {
  importing::StatedDrives drives = options;
  drives.truth.clear();
  for (const importing::DriveFiles& one : files) drives.truth.push_back(one.truth);
  importing::refuse_choices_unused_with_scans(drives);
}

}  // namespace

bool names_scans(const ImportOptions& options) {
  return std::any_of(options.truth.begin(), options.truth.end(),
                     [](const fs::path& word) { return scans_named(word).has_value(); });
}

void add_scan_topic(console::Command command, std::string& topic) {
  command.add_option("--scan-topic", topic, "bags: the topic of the laser scanner's scans")
      .type_name("TOPIC");
}

void calibrate_by_scans(const ImportOptions& options, const CalibrationOutput& output,
                        const std::string& scan_topic) {
  advise(kScanAdvice);
  const std::vector<importing::DriveFiles> files = files_of(options);
  const importing::ScannedDrives drives = stated([&] {
    refuse_unused(options, files);
    return importing::scanned_drives(files, importing::choices_of(options), scan_topic);
  });
  for (const Remark& remark : drives.remarks) console::say(in_words(remark));
  const lidar::ScanCalibration found =
      lidar::calibrate_by_scans(drives.drives, drives.loaded, options.mirrored == "yes");
  for (const Remark& remark : found.remarks) console::say(in_words(remark));
  const bool better = importing::verdict_of(found) == calibration::Verdict::better;
  if (!output.file.empty()) {
    experiment::write_parameter_file(output.file, importing::parameter_file_of(found, drives.wheel));
    console::say("written to " + output.file.string() +
                 (better ? "; load it with: astrolabe upload " + output.file.string()
                         : ", although it is not shown to be better than what the robot carries"));
  }
  if (output.json) {
    print_json(importing::to_json(found));
  } else {
    write(scan_result_text(found));
  }
  if (!better) console::answer_no();
}

}  // namespace astro::commands
