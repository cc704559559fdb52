#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "host/commands/drive/odometry_watch.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/paths.hpp"

/// One drive of a command, from connecting to the line that says where the odometry ended.
namespace astro::commands {

struct DriveOptions {
  ConnectionOptions connection;
  bool json = false;
  std::filesystem::path record;  // empty: nothing is recorded
};

/// --port, --baud, --json and --record of every command that drives.
void add_drive_options(console::Command command, DriveOptions& options);

/// What a drive does while the robot is armed, and its callbacks meanwhile.
struct DriveJob {
  std::function<void(robot::Client&, robot::DriveSession&)> work;
  std::function<void(robot::Client&)> connected = [](const auto&) {};  // before the robot is armed
  std::function<void(const recording::OdometrySample&)> moved = [](const auto&) {};
  std::function<void(const protocol::SegmentDone&)> segment_done = [](const auto&) {};
};

/// Connects, arms, works, lets the robot come to rest, disarms it and prints where the odometry ended. If
/// Ctrl-C ends the work, it prints that, too, and throws Interrupted. A recording is kept however the drive
/// ends.
void drive(DriveOptions& options, const DriveJob& job);

/// The same for a path, with a progress bar.
void drive_path(DriveOptions& options, const robot::Path& path);

/// The same for a velocity that is held for `seconds` by the robot's clock.
void drive_velocity(DriveOptions& options, double v_mps, double omega_radps, double seconds);

}  // namespace astro::commands
