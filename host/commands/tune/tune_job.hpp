#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/commands/shared/connection.hpp"
#include "host/experiment/drive/change_guard.hpp"
#include "host/motor/bench/tuning.hpp"
#include "host/motor/bench/tuning_steps.hpp"

/// `astrolabe tune` from an agreed question to measured results.
namespace astro::commands {

struct TuneOptions {
  ConnectionOptions connection;
  bool on_stand = false, on_ground = false;
  std::string bandwidth;  // "6", "6Hz", "40rad/s"; empty: chosen
  double max_voltage_V = 5, max_distance_m = 1;
  bool upload = false, yes = false, json = false;
  std::filesystem::path out = "tune.html";

  double bandwidth_radps() const;  // 0: chosen
};

/// A step of both wheels and the model's prediction of it. Without `was_measured`, `measured` holds the set
/// points alone.
struct TunedStep {
  std::string title;
  motor::StepCourses measured, predicted;
  bool was_measured = true;
};

struct TuneResult {
  bool on_stand = false;
  motor::RobotFacts before;  // the robot as it was found
  motor::IdentifiedMotors motors;
  motor::GainDesign gains;
  motor::ControlParameters proposed;
  std::vector<robot::Change> changes;  // the proposed parameters that differ from the robot's
  std::vector<TunedStep> steps;
  double period_s = 0, supply_V = 0;
  bool uploaded = false;
};

/// Measures the wheels, designs the gains, measures a step with the gains that the robot has and predicts it
/// with the new ones. The robot is disarmed at the end in every case. Throws astro::Error before anything
/// turns if the bandwidth is far beyond what the robot allows.
TuneResult measure(robot::Client& client, const TuneOptions& options);

/// Loads the proposed values and measures the step again. Throws astro::Error for a measurement that is too
/// poor to be loaded.
void load_and_measure_again(robot::Client& client, TuneResult& result);

}  // namespace astro::commands
