#pragma once

#include <functional>
#include <vector>

#include "host/base/error.hpp"
#include "host/motor/bench/tuning.hpp"
#include "host/motor/bench/tuning_steps.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/parameters/far_change.hpp"

/// Tunes a robot's speed loop: measures its motors, designs feed-forward and gains, and shows on a step of
/// speed what they change. Whoever calls decides between measuring and loading, for as long as it takes:
/// nothing is armed then.
namespace astro::motor {

/// Why nothing is loaded. The value is the name of the wheel.
enum class TuningProblem { poorly_measured };

struct TuningTask {
  bool on_stand = false;       // the wheels hang free; if not, the robot drives to and fro
  double voltage_V = 5;        // most that is put on a motor
  double distance_m = 1;       // on the ground: how far the robot gets from its start, to either side
  double bandwidth_radps = 0;  // of the speed loop; 0: the stiffest against loads

  /// About how long the wheels turn until there is a result.
  double duration_s() const { return 15 + 4 * voltage_V; }
};

struct TuningHooks {
  robot::DriveHooks drive;
  /// The fraction of identifying the motors that is done.
  std::function<void(double)> progress = [](double) {};
  /// The motors are identified; what follows takes a few seconds.
  std::function<void(const IdentifiedMotors&)> identified = [](const IdentifiedMotors&) {};
  /// The new values are in force, and the step is about to be driven again.
  std::function<void(const Remark&)> uploaded = [](const Remark&) {};
};

/// A step of both wheels and the model's prediction of it. Without `was_measured`, `measured` holds the set
/// points alone.
struct TunedStep {
  StepCourses measured, predicted;
  bool was_measured = true;
};

struct TuningResult {
  bool on_stand = false;
  RobotFacts before;  // the robot as it was found
  IdentifiedMotors motors;
  GainDesign gains;
  ControlParameters proposed;
  std::vector<robot::Change> changes;  // the proposed parameters that differ from the robot's
  TunedStep step_before;               // with the values that the robot had
  TunedStep step_after;                // with the new values; predicted until they are loaded
  TunedStep jump;                      // predicted: of the set point, under the new gains alone
  double period_s = 0, supply_V = 0;   // between samples; of the robot's supply
  bool uploaded = false;

  /// How the wheels follow their set point with the new values, measured if they were loaded and else
  /// predicted.
  StepVerdict verdict() const;
};

/// Identifies the motors, designs the gains, measures a step with the gains that the robot has and predicts
/// it with the new ones. Changes no parameter. The robot is disarmed at the end in every case.
///
/// Throws astro::Error before anything turns if the bandwidth is far beyond what the robot allows; and what
/// identify() and design_gains() throw.
TuningResult tune_motors(robot::Client& client, const TuningTask& task, const TuningHooks& hooks);

/// Loads the proposed values and measures the step again.
///
/// Throws astro::Error with TuningProblem::poorly_measured before anything is loaded; what robot::upload()
/// throws, and astro::Error if the robot keeps the old values; and what robot::DriveSession throws, with
/// the new values in force.
void load_and_measure_again(robot::Client& client, TuningResult& result, const TuningHooks& hooks);

}  // namespace astro::motor
