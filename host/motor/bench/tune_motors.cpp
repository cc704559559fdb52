#include "host/motor/bench/tune_motors.hpp"

#include <fmt/format.h>

#include <map>

#include "host/motor/bench/bench.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::motor {
namespace {

std::map<std::string, robot::Value> values_of(const ControlParameters& parameters) {
  return {parameters.begin(), parameters.end()};
}

Bounds bounds_of(const TuningTask& task) {
  Bounds bounds;
  bounds.voltage_V = task.voltage_V;
  if (!task.on_stand) bounds.distance_m = task.distance_m;
  return bounds;
}

void identify_motors(robot::Client& client, const Bounds& bounds, const TuningHooks& hooks,
                     TuningResult& result) {
  Bench bench(client, result.before);
  robot::DriveSession session(client, hooks.drive);
  result.motors = identify(bench, session, bounds, hooks.progress);
  result.period_s = bench.period_s();
  result.supply_V = bench.now().supply_V;
}

void require_good_fit(const IdentifiedMotors& motors) {
  const auto poor = poorly_measured(motors);
  if (!poor) return;
  throw Error(fmt::format("nothing was loaded: the {} wheel was measured too poorly (R^2 {:.3f}); measure "
                          "again with more voltage or more room",
                          name(*poor), motors.wheels[at(*poor)].fit.r_squared),
              TuningProblem::poorly_measured, {name(*poor)});
}

TunedStep drive_step(robot::Client& client, const TuningResult& result, const RobotFacts& facts,
                     const StepPlan& plan, const TuningHooks& hooks) {
  Bench bench(client, facts);
  robot::DriveSession session(client, hooks.drive);
  TunedStep step{measure_step(bench, session, plan.speed_mps, plan.hold_s), {}, true};
  step.predicted = predict_steps(result.motors, facts, result.supply_V, step.measured);
  return step;
}

}  // namespace

StepVerdict TuningResult::verdict() const {
  return judge_step(step_before.measured, step_after.predicted,
                    step_after.was_measured ? &step_after.measured : nullptr);
}

TuningResult tune_motors(robot::Client& client, const TuningTask& task, const TuningHooks& hooks) {
  const auto robot = robot::RemoteParameters::fetch(client);
  TuningResult result;
  result.on_stand = task.on_stand;
  result.before = facts_of(robot);
  require_possible_bandwidth(result.before, task.bandwidth_radps);
  const Bounds bounds = bounds_of(task);
  identify_motors(client, bounds, hooks, result);
  hooks.identified(result.motors);
  result.gains = design_for(result.motors, result.before, task.bandwidth_radps);
  result.proposed = proposed_parameters(result.motors, result.gains.design, result.on_stand);
  result.changes = robot::changes(robot, values_of(result.proposed));
  result.step_before =
      drive_step(client, result, result.before, plan_step(result.gains.mean, result.before, bounds), hooks);
  const StepCourses& driven = result.step_before.measured;
  result.step_after = {
      driven,
      predict_steps(result.motors, with_parameters(result.before, result.proposed), result.supply_V, driven),
      false};
  const StepCourses jump = predict_jump(result.motors, result.before, result.gains.design, result.supply_V,
                                        driven[0].set_point_mps.back());
  result.jump = {jump, jump, false};
  return result;
}

void load_and_measure_again(robot::Client& client, TuningResult& result, const TuningHooks& hooks) {
  require_good_fit(result.motors);
  const robot::UploadReport done = robot::upload(client, values_of(result.proposed));
  if (done.active != robot::ActiveSet::new_set) throw Error(done.remark());
  hooks.uploaded(done.remark());
  result.uploaded = true;
  const auto facts = facts_of(robot::RemoteParameters::fetch(client));
  result.step_after = drive_step(client, result, facts, plan_of(result.step_before.measured), hooks);
}

}  // namespace astro::motor
