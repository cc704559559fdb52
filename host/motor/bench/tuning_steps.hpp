#pragma once

#include <string>
#include <vector>

#include "host/motor/bench/identify.hpp"
#include "host/motor/bench/robot_facts.hpp"
#include "host/motor/bench/step_response.hpp"

/// Steps of speed that show what a tuning does: which step to drive, what the model predicts for it, and
/// whether the wheels follow better. Values in, values out.
namespace astro::motor {

struct StepPlan {
  double speed_mps = 0, hold_s = 0;
};

/// As fast as the voltage bound allows, but at most 0.4 of the robot's speed limit, and short enough for the
/// distance bound.
StepPlan plan_step(const MotorModel& mean, const RobotFacts& robot, const Bounds& bounds);

/// The same step once more, as it was driven.
StepPlan plan_of(const StepCourses& measured);

/// What the identified motors do with the set points of `courses` under the parameters of `robot`.
StepCourses predict_steps(const IdentifiedMotors& motors, const RobotFacts& robot, double supply_V,
                          const StepCourses& courses);

/// A jump of the set point without acceleration limit and feed-forward, under kp and ki of `design` alone: the
/// ramps of a real drive hardly show the loop.
StepCourses predict_jump(const IdentifiedMotors& motors, RobotFacts robot, const Design& design,
                         double supply_V, double speed_mps);

/// How the wheels follow their set points with new values, by the rms error of the wheel that follows worse.
struct StepVerdict {
  enum class Change { better, same, worse };
  Change change = Change::same;
  double before_mps = 0, predicted_mps = 0, now_mps = 0;  // rms errors; now is predicted if not measured
  bool was_measured = false;
  /// The measured error is more than twice the predicted one: slip, play or a weak supply.
  bool unexplained = false;
};

/// `predicted` and `measured`: the step with the new values; `measured` is null if it was not driven. A change
/// counts if it exceeds a tenth and 0.5 mm/s, by which a repeated step differs.
StepVerdict judge_step(const StepCourses& before, const StepCourses& predicted, const StepCourses* measured);

}  // namespace astro::motor
