#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/commands/selftest/own_command.hpp"

namespace astro::commands {

/// The true values of the robot that this program's own demonstrations calibrate: the wheels differ by 0.416 %, the wheelbase is
/// 0.479 % shorter than the robot believes, and the wheels slip as those of the robot that the numbers come from.
inline constexpr double kTrueEd = 1.00416, kTrueWheelbase_m = 0.28861;

/// `astrolabe sim` in a process of its own, with these true values, from when it answers until the end of this object.
class DemoRobot {
 public:
  /// Throws astro::Error if it does not start, Interrupted on Ctrl-C.
  explicit DemoRobot(const std::filesystem::path& port, const std::vector<std::string>& options);
  ~DemoRobot();
  DemoRobot(const DemoRobot&) = delete;
  DemoRobot& operator=(const DemoRobot&) = delete;

  /// The line with which it said something, for instance where its pose is sent.
  std::string line_with(const std::string& text) { return process_.line_with(text); }

 private:
  OwnCommand process_;
};

}  // namespace astro::commands
