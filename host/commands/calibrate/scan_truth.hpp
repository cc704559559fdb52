#pragma once

#include <string>

#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/console/options.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/lidar/scan.hpp"

/// The scans of the robot's own laser scanner as ground truth: --truth scan:FILE.
namespace astro::commands {

/// Whether one of the truths is "scan:FILE".
bool names_scans(const ImportOptions& options);

/// --range-scale-error: the standard error of the common scale of a scanner's ranges, in per cent; and --loaded-scale-error, that of
/// the S that the robot carries.
struct ScaleOptions {
  double range_percent = 100 * lidar::kRangeScaleSigma, loaded_percent = 0;
  console::Option range, loaded;

  double range_sigma() const { return range_percent / 100; }
  bool given() const { return range.count() > 0 || loaded.count() > 0; }
  /// If --loaded-scale-error is given. Precondition: found by scans.
  void weigh_loaded(experiment::Calibration& found) const;
};
void add_scales(console::Command command, ScaleOptions& scales);

/// What is said of scans in files and bags.
struct ScanOptions {
  std::string topic;
  ScaleOptions scales;

  bool given() const { return !topic.empty() || scales.given(); }
};

/// --scan-topic, --range-scale-error and --loaded-scale-error.
void add_scan_options(console::Command command, ScanOptions& options);

/// Calibrates by scans and puts the result out; the exit code is 3 unless the factors are shown to be better. Throws
/// console::WrongUsage if other truths are named as well, or an option that does not apply to scans; and what the readers and
/// lidar::calibrate_by_scans throw.
void calibrate_by_scans(const ImportOptions& options, const CalibrationOutput& output,
                        const ScanOptions& scans);

}  // namespace astro::commands
