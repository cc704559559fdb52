#include "host/motor/bench/tuning_steps.hpp"

#include <algorithm>

namespace astro::motor {
namespace {

constexpr double kSettle_s = 0.8;      // of a step, after its ramp
constexpr double kStepRoom = 0.6;      // of the distance that is allowed
constexpr double kOfSpeedLimit = 0.4;  // enough to see, and slow enough for a small room

double rms_error_mps(const StepCourses& courses) {
  return std::max(figures(courses[0]).rms_error_mps, figures(courses[1]).rms_error_mps);
}

}  // namespace

StepPlan plan_step(const MotorModel& mean, const RobotFacts& robot, const Bounds& bounds) {
  const double by_voltage_mps = 0.8 * (bounds.voltage_V - mean.kS) / mean.kV;
  double speed_mps = std::min(kOfSpeedLimit * robot.speed_limit_mps, by_voltage_mps);
  const auto hold_s = [&] { return speed_mps / robot.acceleration_limit_mps2 + kSettle_s; };
  while (speed_mps * hold_s() > kStepRoom * bounds.distance_m) speed_mps *= 0.9;
  return {speed_mps, hold_s()};
}

StepPlan plan_of(const StepCourses& measured) {
  return {measured[0].set_point_mps.back(), measured[0].time_s.back()};
}

StepCourses predict_steps(const IdentifiedMotors& motors, const RobotFacts& robot, double supply_V,
                          const StepCourses& courses) {
  StepCourses answer;
  for (const Side side : kSides) {
    const IdentifiedMotor& wheel = motors.wheels[at(side)];
    answer[at(side)] = predicted(
        courses[at(side)],
        {wheel.fit.model, wheel.breakaway_V(), robot.feed_forward[at(side)], robot.kp, robot.ki,
         robot.observer_radps, std::min(robot.motor_voltage_max_V, supply_V), robot.count_m[at(side)]});
  }
  return answer;
}

StepCourses predict_jump(const IdentifiedMotors& motors, RobotFacts robot, const Design& design,
                         double supply_V, double speed_mps) {
  constexpr double kNoLimit_mps2 = 1e9, kLength_s = 0.6;
  const StepCourse jump = ramp(speed_mps, kNoLimit_mps2, kLength_s);
  robot.kp = design.kp;
  robot.ki = design.ki;
  robot.feed_forward = {};
  return predict_steps(motors, robot, supply_V, {jump, jump});
}

StepVerdict judge_step(const StepCourses& before, const StepCourses& predicted, const StepCourses* measured) {
  constexpr double kSame = 0.1, kSame_mps = 5e-4;  // encoders resolve no less than kSame_mps
  constexpr double kUnexplained = 2.0;
  StepVerdict verdict;
  verdict.was_measured = measured != nullptr;
  verdict.before_mps = rms_error_mps(before);
  verdict.predicted_mps = rms_error_mps(predicted);
  verdict.now_mps = measured != nullptr ? rms_error_mps(*measured) : verdict.predicted_mps;
  const double same_mps = std::max(kSame * verdict.before_mps, kSame_mps);
  if (verdict.now_mps < verdict.before_mps - same_mps) verdict.change = StepVerdict::Change::better;
  if (verdict.now_mps > verdict.before_mps + same_mps) verdict.change = StepVerdict::Change::worse;
  verdict.unexplained =
      verdict.was_measured && verdict.now_mps > kUnexplained * verdict.predicted_mps + kSame_mps;
  return verdict;
}

}  // namespace astro::motor
