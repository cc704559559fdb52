#include "host/commands/tune/tune_job.hpp"
#include "host/commands/base/advice.hpp"

#include <fmt/format.h>

#include <numbers>

#include "host/base/error.hpp"
#include "host/console/console.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::commands {
namespace {

experiment::ParameterValues values_of(const motor::ControlParameters& parameters) {
  return {parameters.begin(), parameters.end()};
}

motor::Bounds bounds_of(const TuneOptions& options) {
  motor::Bounds bounds;
  bounds.voltage_V = options.max_voltage_V;
  if (!options.on_stand) bounds.distance_m = options.max_distance_m;
  return bounds;
}

void require_good_fit(const motor::IdentifiedMotors& motors) {
  const auto poor = motor::poorly_measured(motors);
  if (!poor) return;
  throw Error(
      fmt::format("nothing was loaded: the {} wheel was measured too poorly (R^2 {:.3f}); measure "
                  "again with more voltage or more room",
                  name(*poor), motors.wheels[at(*poor)].fit.r_squared));
}

TunedStep drive_step(robot::Client& client, const TuneResult& result, const motor::RobotFacts& facts,
                     const motor::StepPlan& plan, const std::string& title) {
  motor::Bench bench(client, facts);
  robot::DriveSession session(client, drive_hooks());
  TunedStep step{title, measure_step(bench, session, plan.speed_mps, plan.hold_s), {}, true};
  step.predicted = predict_steps(result.motors, facts, result.supply_V, step.measured);
  return step;
}

/// Three step responses: measured with the old values, predicted for the new ones, and predicted for the new gains alone.
std::vector<TunedStep> steps_before_upload(robot::Client& client, const TuneResult& result,
                                           const motor::Bounds& bounds) {
  const TunedStep before = drive_step(client, result, result.before,
                                      plan_step(result.gains.mean, result.before, bounds), "before");
  const auto after = predict_steps(result.motors, with_parameters(result.before, result.proposed),
                                   result.supply_V, before.measured);
  const auto jump = predict_jump(result.motors, result.before, result.gains.design, result.supply_V,
                                 before.measured[0].set_point_mps.back());
  return {before,
          {"with the new values", before.measured, after, false},
          {"a jump, new gains alone", jump, jump, false}};
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
  motor::require_possible_bandwidth(result.before, options.bandwidth_radps());
  {
    motor::Bench bench(client, result.before);
    robot::DriveSession session(client, drive_hooks());
    console::Progress progress("measuring");
    result.motors = identify(bench, session, bounds, [&](double part) { progress.show(part); });
    result.period_s = bench.period_s();
    result.supply_V = bench.now().supply_V;
  }
  result.gains = design_for(result.motors, result.before, options.bandwidth_radps());
  result.proposed = proposed_parameters(result.motors, result.gains.design, result.on_stand);
  result.changes = robot::changes(robot, values_of(result.proposed));
  result.steps = steps_before_upload(client, result, bounds);
  return result;
}

void load_and_measure_again(robot::Client& client, TuneResult& result) {
  require_good_fit(result.motors);
  const robot::UploadReport done = robot::upload(client, values_of(result.proposed));
  if (done.active != robot::ActiveSet::new_set) throw Error(done.remark());
  console::say(in_words(done.remark()));
  result.uploaded = true;
  const auto facts = motor::facts_of(robot::RemoteParameters::fetch(client));
  result.steps[1] = drive_step(client, result, facts, plan_of(result.steps[0].measured), "after");
}

}  // namespace astro::commands
