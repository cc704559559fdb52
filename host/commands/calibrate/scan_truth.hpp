#pragma once

#include <string>

#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/shared/import_options.hpp"

/// The scans of the robot's own laser scanner as ground truth: --truth scan:FILE.
namespace astro::commands {

/// Whether one of the truths is "scan:FILE".
bool names_scans(const ImportOptions& options);

/// Calibrates by scans and puts the result out; the exit code is 3 unless the factors are shown to be better. Throws
/// console::WrongUsage if other truths are named as well, or an option that does not apply to scans; and what the readers and
/// lidar::calibrate_by_scans throw.
void calibrate_by_scans(const ImportOptions& options, const CalibrationOutput& output,
                        const std::string& scan_topic);

/// --scan-topic.
void add_scan_topic(console::Command command, std::string& topic);

}  // namespace astro::commands
