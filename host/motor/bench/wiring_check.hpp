#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/base/error.hpp"
#include "host/motor/bench/robot_facts.hpp"
#include "host/motor/model/roll.hpp"
#include "host/motor/model/wiring.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/parameters/far_change.hpp"

/// Checks the wires of a robot with its wheels off the ground: drives one motor after the other, asks what
/// turned, and loads the parameters that correct what parameters can correct. Afterwards, if it is wanted,
/// a person rolls the robot along a tape measure, which shows whether its counts per revolution are right.
namespace astro::motor {

/// How far a robot was rolled: one of them was measured.
struct RolledLength {
  std::optional<double> distance_m = {}, turns = {};  // turns: of a wheel
};

/// What a person says after a motor was driven.
struct Look {
  std::optional<Sighting> seen;  // nullopt: nobody looked
  bool again = false;            // it was missed: the motor is driven once more
};

/// Callbacks for progress and questions. Nothing is armed while one of them runs, except for those of
/// `drive`.
struct WiringHooks {
  robot::DriveHooks drive;
  /// This motor is about to be driven forward.
  std::function<void(Side)> driving = [](Side) {};
  std::function<Look(Side)> look = [](Side) { return Look{}; };
  /// A motor was driven for the last time.
  std::function<void(const Probe&)> driven = [](const Probe&) {};
  std::function<void(const WiringVerdict&)> wires_judged = [](const WiringVerdict&) {};
  /// Has the robot rolled by hand and returns how far it was. `wait_until_rolled` waits until the wheels
  /// have turned and stand again, for whoever knows the length beforehand; it throws Interrupted, and Error
  /// if nobody rolls the robot for a minute. Empty: the robot is not rolled.
  std::function<RolledLength(const RobotFacts&, const std::function<void()>& wait_until_rolled)> roll;
  std::function<void(const RollVerdict&)> roll_judged = [](const RollVerdict&) {};
  /// Whether these changes are loaded.
  std::function<bool(const std::vector<robot::Change>&)> load = [](const std::vector<robot::Change>&) {
    return false;
  };
  std::function<void(const Remark&)> uploaded = [](const Remark&) {};
};

struct WiringResult {
  /// What comes next, the first of these that applies.
  enum class Next {
    change_wires,     // by hand
    load_parameters,  // they were offered and not loaded
    look,             // which wheel turned decides which parameters are right
    nothing           // the robot is in order
  };

  WiringVerdict wires;
  std::optional<RollVerdict> roll;  // nullopt: it was not rolled
  bool in_force = true;             // all parameters that were offered

  Next next() const;
};

/// Drives each motor with at most `most_V`. A robot whose wires have to be changed by hand is not rolled.
///
/// Throws what robot::DriveSession throws; what judge_roll() and robot::upload() throw;
/// astro::Error if the robot keeps the old parameters. The robot is disarmed at the end in every case.
WiringResult check_wires(robot::Client& client, double most_V, const WiringHooks& hooks);

}  // namespace astro::motor
