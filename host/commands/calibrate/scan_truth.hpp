#pragma once

#include <string>

#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/console/options.hpp"
#include "host/lidar/scan.hpp"

/// The scans of the robot's own laser scanner as ground truth: --truth scan:FILE.
namespace astro::commands {

/// Whether one of the truths is "scan:FILE".
bool names_scans(const ImportOptions& options);

/// --range-scale-error: the standard error of the common scale of a scanner's ranges, in per cent.
struct RangeScaleOption {
  double percent = 100 * lidar::kRangeScaleSigma;
  console::Option option;

  double sigma() const { return percent / 100; }
};
void add_range_scale(console::Command command, RangeScaleOption& range_scale);

/// What is said of scans in files and bags.
struct ScanOptions {
  std::string topic;
  RangeScaleOption range_scale;

  bool given() const { return !topic.empty() || range_scale.option.count() > 0; }
};

/// --scan-topic and --range-scale-error.
void add_scan_options(console::Command command, ScanOptions& options);

/// Calibrates by scans and puts the result out; the exit code is 3 unless the factors are shown to be better. Throws
/// console::WrongUsage if other truths are named as well, or an option that does not apply to scans; and what the readers and
/// lidar::calibrate_by_scans throw.
void calibrate_by_scans(const ImportOptions& options, const CalibrationOutput& output,
                        const ScanOptions& scans);

}  // namespace astro::commands
