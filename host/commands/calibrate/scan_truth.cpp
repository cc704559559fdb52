#include "host/commands/calibrate/scan_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/commands/base/advice.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/commands/shared/gyro_view.hpp"
#include "host/commands/shared/option_words.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/scan_figures.hpp"
#include "host/import/scans/carmen_log.hpp"
#include "host/import/scans/scanned_drives.hpp"
#include "host/lidar/scan_calibration.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "scan:";

constexpr Advice kScanAdvice[] = {
    {lidar::ScanProblem::mirrored,
     "; give --truth-mirrored if it is the scans (of files and bags --truth-mirrored yes); if it is the "
     "wheels, "
     "of files and bags --swap-wheels, and for a robot of ours 'astrolabe check-wiring'"},
    {lidar::ScanProblem::not_mirrored,
     "; leave out --truth-mirrored yes, or give --swap-wheels if left and right are exchanged as well"},
    {importing::ScanFileProblem::topic_unclear, ": name one with --scan-topic"},
    {importing::ScanFileProblem::no_topics, ": leave out --scan-topic"},
    {importing::ScanFileProblem::wheels_of_other_file, ": give the same file as --wheels"}};

std::optional<fs::path> scans_named(const fs::path& word) {
  const std::string& text = word.native();
  if (text == kPrefix)
    throw console::WrongUsage("--truth scan: names no file: write scan:FILE, as scan:drive.mcap");
  if (!text.starts_with(kPrefix)) return std::nullopt;
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

void ScaleOptions::weigh_loaded(experiment::Calibration& found) const {
  if (loaded.count() > 0) experiment::weigh_loaded_scale(loaded_percent / 100, found);
}

void add_scales(console::Command command, ScaleOptions& scales) {
  scales.range =
      add_ranged(command, "--range-scale-error", scales.range_percent,
                 "scans: standard error of the scale of the scanner's\nranges, which no drive shows",
                 "PERCENT", 0.001, 20, "%");
  scales.loaded = add_ranged(command, "--loaded-scale-error", scales.loaded_percent,
                             "scans: standard error of the S that is loaded, if a\ntape or a tracker has "
                             "measured it: then it counts, too",
                             "PERCENT", 0.001, 20, "%");
}

void add_scan_options(console::Command command, ScanOptions& options) {
  advise(kScanAdvice);
  command.add_option("--scan-topic", options.topic, "bags: the topic of the laser scanner's scans")
      .type_name("TOPIC");
  add_scales(command, options.scales);
}

void calibrate_by_scans(const ImportOptions& options, const CalibrationOutput& output,
                        const ScanOptions& scans) {
  const std::vector<importing::DriveFiles> files = files_of(options);
  const importing::ScannedDrives drives = stated([&] {
    refuse_unused(options, files);
    return importing::scanned_drives(files, importing::choices_of(options), scans.topic);
  });
  for (const Remark& remark : drives.remarks) console::say(in_words(remark));
  const bool mirrored = options.mirrored == "yes";
  experiment::Calibration found = experiment::calibration_of(
      lidar::calibrate_by_scans(drives.drives, drives.loaded, mirrored), scans.scales.range_sigma());
  scans.scales.weigh_loaded(found);
  found.wheel = drives.wheel;
  put_out(
      found, output, [&] { return experiment::scan_report(found, drives.drives, mirrored); },
      gyro_of(drives.set, found));
}

}  // namespace astro::commands
