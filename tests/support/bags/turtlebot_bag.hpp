#pragma once

#include <cstdint>
#include <filesystem>

#include "hal/sim/config.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/simulation/robot/virtual_scanner.hpp"
#include "host/simulation/room/room.hpp"

/// A bag as a TurtleBot-like robot records it, made by the simulated robot in virtual time.
namespace astro::support {

/// The gyro of /imu: what it says is (1 + scale) times the true rate `lag_s` ago, plus bias and noise.
struct BagGyro {
  double rate_hz = 100;
  double scale = 0;
  double bias_radps = 0;
  double noise_radps = 0.002;  // standard deviation of a sample
  double lag_s = 0;
};

struct BagDrive {
  sim::Config robot;
  simulation::Room room;
  simulation::ScannerConfig scanner;
  BagGyro gyro;
  robot::Path path;
  // What the bag holds beside /scan, /imu and /tf_static. /odom is dead reckoning of the counts with the nominal sizes.
  bool has_joint_states = true;
  bool has_odometry = true;
  double scans_late_s = 0;  // the stamps of /scan are later than the truth by this
  /// What /tf_static says of the scanner's place on the robot, which people measure with a ruler.
  Pose2 stated_mount{};
  std::uint64_t seed = 1;
};

/// Drives the path and writes, with the stamps of one computer that runs since the epoch:
///
///   /joint_states  wheel_left_joint and wheel_right_joint, rad, by the nominal counts for a turn, 33 Hz
///   /odom          odom -> base_footprint, 33 Hz
///   /scan          frame base_scan
///   /imu           frame imu_link; the rate about z, no orientation
///   /tf_static     base_footprint -> base_link -> base_scan and imu_link
///
/// `path`: a file that ends in .mcap, or a folder for a bag in SQLite.
void record_bag(const BagDrive& drive, const std::filesystem::path& path);

/// Squares of this side both ways round, circles both ways, and a spin each way: what shows all factors.
robot::Path calibration_drive(double side_m, int squares_each_way);

}  // namespace astro::support
