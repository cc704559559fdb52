#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/commands/shared/connection.hpp"
#include "host/experiment/drive/change_guard.hpp"
#include "host/motor/model/design.hpp"
#include "host/motor/bench/identify.hpp"
#include "host/motor/bench/step_response.hpp"

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

/// A step of both wheels, and what the model says of it.
struct TunedStep {
  std::string title;
  motor::StepCourses measured, predicted;
  bool was_measured = true;
};

struct TuneResult {
  bool on_stand = false;
  motor::RobotFacts before;  // what the robot carried
  motor::Identity identity;
  motor::MotorModel mean;  // of both wheels: what the gains are for
  motor::Design design;
  motor::Margins margins_before;   // of the gains that were carried, on the measured motors
  experiment::ParameterValues values;       // proposed
  std::vector<experiment::Change> changes;  // those of them that change something
  std::vector<TunedStep> steps;
  double period_s = 0, supply_V = 0;
  bool uploaded = false;
};

/// Measures the wheels, designs, measures a step with the gains that the robot carries and predicts it with
/// the new ones. The robot is disarmed at the end, however that comes. Throws astro::Error before anything
/// turns if the bandwidth cannot be meant.
TuneResult measure(robot::Client& client, const TuneOptions& options);

/// Loads the proposed values and measures the step again. Throws astro::Error for a measurement that is too
/// poor to be loaded.
void load_and_measure_again(robot::Client& client, TuneResult& result);

}  // namespace astro::commands
