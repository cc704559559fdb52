#include "host/motor/bench/tuning.hpp"

#include <algorithm>
#include <cmath>

namespace astro::motor {
namespace {

constexpr double kGoodFit = 0.98, kPoorGain = 0.05, kPoorInertia = 0.2;

// The gains serve both wheels, so the coarser encoder decides how much noise they pass on.
double coarsest_m(const RobotFacts& robot) { return std::max(robot.count_m[0], robot.count_m[1]); }

// Digits beyond the fourth are noise, and nobody can compare them.
double rounded(double value) {
  if (value == 0) return 0;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3);
  return std::round(value / step) * step;
}

std::string of(const char* parameter, Side side) { return std::string(parameter) + '_' + name(side); }

}  // namespace

MotorModel mean_model(const IdentifiedMotors& motors) {
  const MotorModel& left = motors.wheels[0].fit.model;
  const MotorModel& right = motors.wheels[1].fit.model;
  return {(left.kS + right.kS) / 2, (left.kV + right.kV) / 2, (left.kA + right.kA) / 2};
}

GainDesign design_for(const IdentifiedMotors& motors, const RobotFacts& robot, double bandwidth_radps) {
  const MotorModel mean = mean_model(motors);
  return {mean, design_gains({mean, robot.observer_radps, coarsest_m(robot), bandwidth_radps}),
          margins({mean, robot.kp, robot.ki, robot.observer_radps})};
}

void require_possible_bandwidth(const RobotFacts& robot, double bandwidth_radps) {
  constexpr double kFarBeyondLargest = 1.5;
  const MotorModel& present = robot.feed_forward[0];
  if (!(present.kV > 0) || !(present.kA > 0)) return;
  DesignTask task{present, robot.observer_radps, coarsest_m(robot)};
  if (bandwidth_radps <= kFarBeyondLargest * design_gains(task).largest_bandwidth_radps) return;
  task.bandwidth_radps = bandwidth_radps;
  design_gains(task);
}

ControlParameters proposed_parameters(const IdentifiedMotors& motors, const Design& design, bool on_stand) {
  ControlParameters values;
  for (const Side side : kSides) {
    const MotorModel& model = motors.wheels[at(side)].fit.model;
    values[of("kS", side)] = rounded(std::max(0.0, model.kS));
    values[of("kV", side)] = rounded(model.kV);
    if (!on_stand) values[of("kA", side)] = rounded(model.kA);
  }
  if (on_stand) return values;
  values["kp"] = rounded(design.kp);
  values["ki"] = rounded(design.ki);
  return values;
}

RobotFacts with_parameters(RobotFacts robot, const ControlParameters& values) {
  const auto take = [&](const std::string& name, double& into) {
    const auto found = values.find(name);
    if (found != values.end()) into = found->second;
  };
  take("kp", robot.kp);
  take("ki", robot.ki);
  for (const Side side : kSides) {
    take(of("kS", side), robot.feed_forward[at(side)].kS);
    take(of("kV", side), robot.feed_forward[at(side)].kV);
    take(of("kA", side), robot.feed_forward[at(side)].kA);
  }
  return robot;
}

std::optional<Side> poorly_measured(const IdentifiedMotors& motors) {
  for (const Side side : kSides) {
    const MotorFit& fit = motors.wheels[at(side)].fit;
    if (fit.r_squared < kGoodFit || fit.standard_error.kV > kPoorGain * fit.model.kV ||
        fit.standard_error.kA > kPoorInertia * fit.model.kA)
      return side;
  }
  return std::nullopt;
}

std::optional<double> unlikely_kV_ratio(const MotorModel& mean, const RobotFacts& robot) {
  constexpr double kOther = 1.6;
  const double present = (robot.feed_forward[0].kV + robot.feed_forward[1].kV) / 2;
  const double ratio = present > 0 ? mean.kV / present : 1;
  if (ratio > kOther || ratio < 1 / kOther) return ratio;
  return std::nullopt;
}

}  // namespace astro::motor
