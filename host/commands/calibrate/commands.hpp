#pragma once

#include "host/console/command_line.hpp"

/// The subcommand that calibrates and judges, and its own subcommands. Each is a file named after it and adds itself to the
/// command that it belongs to: options, examples in its footer, and a callback that does the work.
///
/// Output  data on stdout; everything else (progress, questions, warnings) on stderr.
/// Errors  a callback throws astro::Error with one sentence; main prints it and exits with 1. Wrong usage exits
///         with 2, Ctrl-C with 130.
namespace astro::commands {

void add_calibrate(console::Command app);

/// `calibrate runs`: from recorded runs with ground truth.
void add_calibrate_runs(console::Command calibrate);
/// `calibrate files`: from wheels and ground truth that other programs recorded.
void add_calibrate_files(console::Command calibrate);
/// `calibrate bag`: from bags of ROS 2 that hold wheels and ground truth.
void add_calibrate_bag(console::Command calibrate);
/// `calibrate gyro`: from wheels and a gyro alone, without ground truth.
void add_calibrate_gyro(console::Command calibrate);
/// `calibrate end-poses`: from measured end-pose errors of squares.
void add_calibrate_end_poses(console::Command calibrate);
/// `calibrate check`: the odometry errors of calibrations on recorded drives.
void add_calibrate_check(console::Command calibrate);
/// `calibrate export`: a calibration for other programs.
void add_calibrate_export(console::Command calibrate);

}  // namespace astro::commands
