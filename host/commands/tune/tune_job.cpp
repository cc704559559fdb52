#include "host/commands/tune/tune_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/base/error.hpp"
#include "host/console/console.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::commands {
namespace {

using motor::kSides;
using motor::MotorModel;
using motor::Side;
using motor::RobotFacts;

constexpr double kSettle_s = 0.8;      // of a step, after its ramp
constexpr double kStepRoom = 0.6;      // of the distance that is allowed
constexpr double kOfSpeedLimit = 0.4;  // enough to see, and slow enough for a small room
constexpr double kGoodFit = 0.98, kPoorGain = 0.05, kPoorInertia = 0.2;

MotorModel mean_of(const motor::Identity& identity) {
  const MotorModel& left = identity.wheels[0].fit.model;
  const MotorModel& right = identity.wheels[1].fit.model;
  return {(left.kS + right.kS) / 2, (left.kV + right.kV) / 2, (left.kA + right.kA) / 2};
}

/// What the robot would carry with `values` in force.
RobotFacts with(RobotFacts facts, const experiment::ParameterValues& values) {
  const auto take = [&](const std::string& name, double& into) {
    const auto found = values.find(name);
    if (found != values.end()) into = std::get<double>(found->second);
  };
  take("kp", facts.kp);
  take("ki", facts.ki);
  for (const Side side : kSides) {
    const std::string of = std::string("_") + name(side);
    take("kS" + of, facts.feed_forward[at(side)].kS);
    take("kV" + of, facts.feed_forward[at(side)].kV);
    take("kA" + of, facts.feed_forward[at(side)].kA);
  }
  return facts;
}

// Digits beyond the fourth are noise, and nobody can compare them.
double rounded(double value) {
  if (value == 0) return 0;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3);
  return std::round(value / step) * step;
}

experiment::ParameterValues proposal(const TuneResult& result) {
  experiment::ParameterValues values;
  for (const Side side : kSides) {
    const std::string of = std::string("_") + name(side);
    const MotorModel& model = result.identity.wheels[at(side)].fit.model;
    values["kS" + of] = rounded(std::max(0.0, model.kS));
    values["kV" + of] = rounded(model.kV);
    if (!result.on_stand) values["kA" + of] = rounded(model.kA);
  }
  if (result.on_stand) return values;  // kA lacks the robot's mass, and the gains follow from kA
  values["kp"] = rounded(result.design.kp);
  values["ki"] = rounded(result.design.ki);
  return values;
}

motor::StepCourses predict(const TuneResult& result, const RobotFacts& facts,
                            const motor::StepCourses& courses) {
  motor::StepCourses answer;
  for (const Side side : kSides) {
    const motor::WheelIdentity& wheel = result.identity.wheels[at(side)];
    answer[at(side)] = predicted(
        courses[at(side)], {wheel.fit.model, wheel.breakaway_V(), facts.feed_forward[at(side)], facts.kp,
                            facts.ki, facts.observer_radps,
                            std::min(facts.motor_voltage_max_V, result.supply_V), facts.count_m[at(side)]});
  }
  return answer;
}

struct StepPlan {
  double speed_mps, hold_s;
};

// As fast as the voltage that was allowed, and slow enough for the room.
StepPlan plan_step(const TuneResult& result, const motor::Bounds& bounds) {
  const double by_voltage_mps = 0.8 * (bounds.voltage_V - result.mean.kS) / result.mean.kV;
  double speed_mps = std::min(kOfSpeedLimit * result.before.speed_limit_mps, by_voltage_mps);
  const auto hold_s = [&] { return speed_mps / result.before.acceleration_limit_mps2 + kSettle_s; };
  while (speed_mps * hold_s() > kStepRoom * bounds.distance_m) speed_mps *= 0.9;
  return {speed_mps, hold_s()};
}

motor::Bounds bounds_of(const TuneOptions& options) {
  motor::Bounds bounds;
  bounds.voltage_V = options.max_voltage_V;
  if (!options.on_stand) bounds.distance_m = options.max_distance_m;
  return bounds;
}

double coarsest_m(const RobotFacts& facts) { return std::max(facts.count_m[0], facts.count_m[1]); }

// What is far beyond the observer by the values that the robot carries need not be measured first.
void check_bandwidth(const RobotFacts& facts, double bandwidth_radps) {
  constexpr double kFar = 1.5;
  const MotorModel& carried = facts.feed_forward[0];
  if (!(carried.kV > 0) || !(carried.kA > 0)) return;
  motor::DesignTask task{carried, facts.observer_radps, coarsest_m(facts)};
  if (bandwidth_radps <= kFar * design_gains(task).largest_bandwidth_radps) return;
  task.bandwidth_radps = bandwidth_radps;
  design_gains(task);
}

void design(TuneResult& result, double bandwidth_radps) {
  result.mean = mean_of(result.identity);
  result.design = motor::design_gains(
      {result.mean, result.before.observer_radps, coarsest_m(result.before), bandwidth_radps});
  result.margins_before = motor::margins(
      {result.mean, result.before.kp, result.before.ki, result.before.observer_radps});
}

void check_quality(const TuneResult& result) {
  for (const Side side : kSides) {
    const auto& fit = result.identity.wheels[at(side)].fit;
    const bool poor = fit.r_squared < kGoodFit || fit.standard_error.kV > kPoorGain * fit.model.kV ||
                      fit.standard_error.kA > kPoorInertia * fit.model.kA;
    if (poor)
      throw Error(
          fmt::format("nothing was loaded: the {} wheel was measured too poorly (R^2 {:.3f}); measure "
                      "again with more voltage or more room",
                      name(side), fit.r_squared));
  }
}

TunedStep step(robot::Client& client, const TuneResult& result, const RobotFacts& facts, const StepPlan& plan,
               const std::string& title) {
  motor::Bench bench(client, facts);
  robot::DriveSession session(client, drive_hooks());
  TunedStep step{title, measure_step(bench, session, plan.speed_mps, plan.hold_s), {}, true};
  step.predicted = predict(result, facts, step.measured);
  return step;
}

// What the designed gains do without limits and feed-forward: the ramps of a real drive hardly show it.
TunedStep loop_alone(const TuneResult& result) {
  constexpr double kNoLimit_mps2 = 1e9, kLength_s = 0.6;
  const double speed_mps = result.steps[0].measured[0].set_point_mps.back();
  const motor::StepCourse jump = motor::ramp(speed_mps, kNoLimit_mps2, kLength_s);
  RobotFacts facts = result.before;
  facts.kp = result.design.kp;
  facts.ki = result.design.ki;
  facts.feed_forward = {};
  return {"a jump, new gains alone", {jump, jump}, predict(result, facts, {jump, jump}), false};
}

}  // namespace

double TuneOptions::bandwidth_radps() const {
  if (bandwidth.empty()) return 0;
  const double number = std::stod(bandwidth);
  return bandwidth.ends_with("rad/s") ? number : 2 * std::numbers::pi * number;
}

TuneResult measure(robot::Client& client, const TuneOptions& options) {
  const auto robot = robot::RemoteParameters::fetch(client);
  TuneResult result;
  result.on_stand = options.on_stand;
  result.before = motor::facts_of(robot);
  const motor::Bounds bounds = bounds_of(options);
  check_bandwidth(result.before, options.bandwidth_radps());
  {
    motor::Bench bench(client, result.before);
    robot::DriveSession session(client, drive_hooks());
    console::Progress progress("measuring");
    result.identity = identify(bench, session, bounds, [&](double part) { progress.show(part); });
    result.period_s = bench.period_s();
    result.supply_V = bench.now().supply_V;
  }
  design(result, options.bandwidth_radps());
  result.values = proposal(result);
  result.changes = experiment::changes(robot, result.values);
  result.steps.push_back(step(client, result, result.before, plan_step(result, bounds), "before"));
  TunedStep next{"with the new values", result.steps[0].measured, {}, false};
  next.predicted = predict(result, with(result.before, result.values), next.measured);
  result.steps.push_back(next);
  result.steps.push_back(loop_alone(result));
  return result;
}

void load_and_measure_again(robot::Client& client, TuneResult& result) {
  check_quality(result);
  const robot::UploadReport done = robot::upload(client, result.values);
  if (done.active != robot::ActiveSet::new_set) throw Error(done.sentence());
  console::say(done.sentence());
  result.uploaded = true;
  const auto facts = motor::facts_of(robot::RemoteParameters::fetch(client));
  const motor::StepCourse& before = result.steps[0].measured[0];
  const StepPlan plan{before.set_point_mps.back(), before.time_s.back()};
  result.steps[1] = step(client, result, facts, plan, "after");
}

}  // namespace astro::commands
