#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "host/commands/shared/connection.hpp"
#include "host/recording/run.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/paths.hpp"

/// One drive of a command, from connecting to the line that shows where the odometry ended, and steering during the drive.
namespace astro::commands {

struct DriveOptions {
  ConnectionOptions connection;
  bool json = false;
  std::filesystem::path record;  // empty: nothing is recorded
};

/// --port, --baud, --json and --record of every command that drives.
void add_drive_options(console::Command command, DriveOptions& options);

/// Repeats a velocity often enough for the robot's command time-out. It uses the robot's clock, because the
/// clock of a simulator in fast motion runs ahead of ours, and needs telemetry at 20 ms or less to see it.
class Steering {
 public:
  Steering(robot::Client& client, robot::DriveSession& session) : client_(client), session_(session) {}

  /// Sends the velocity and waits until the next one is due, at most 50 ms. Throws as DriveSession does.
  void step(double v_mps, double omega_radps);

  /// Holds the velocity for this duration by the robot's clock, then ramps to rest.
  void hold(double v_mps, double omega_radps, microseconds duration);

 private:
  robot::Client& client_;
  robot::DriveSession& session_;
};

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
