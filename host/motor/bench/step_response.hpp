#pragma once

#include <array>
#include <vector>

#include "host/motor/model/prediction.hpp"
#include "host/motor/model/step_figures.hpp"
#include "host/motor/bench/bench.hpp"

/// A step of the commanded speed, as the robot answers it and as the model says it will.
///
/// The command jumps; what the wheels are to follow is that command behind the robot's own limits and
/// shaping. Those are left as they are: a robot with its acceleration limit lifted would be measured as it
/// never drives, and one whose host died then would keep a wrong limit in its flash. So the prediction takes
/// the set points that the robot reports, tick by tick, and holds for any shaping.
namespace astro::motor {

struct StepCourse {
  std::vector<double> time_s;  // from the first set point that is not 0
  std::vector<double> set_point_mps, observed_mps;
};
using StepCourses = std::array<StepCourse, 2>;  // left, right

/// Forward for `hold_s` at this speed, to rest, and as far back. Returns the way forward until the ramp down.
StepCourses measure_step(Bench& bench, robot::DriveSession& session, double speed_mps, double hold_s);

/// The set points of a jump behind nothing but an acceleration limit, one a tick.
StepCourse ramp(double speed_mps, double acceleration_mps2, double hold_s);

/// What `loop` makes of the set points of a course, at its times.
StepCourse predicted(const StepCourse& course, const motor::WheelLoop& loop);

motor::StepFigures figures(const StepCourse& course);

}  // namespace astro::motor
