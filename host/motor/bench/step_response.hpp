#pragma once

#include <array>
#include <vector>

#include "host/motor/bench/bench.hpp"
#include "host/motor/model/prediction.hpp"

/// The response to a step of the commanded speed, measured and predicted.
///
/// The command jumps; the set points of the wheels are that command after the robot's own limits and shaping.
/// These stay as they are: without its acceleration limit the robot would be measured as it never drives, and
/// if the host died meanwhile, the robot would keep a wrong limit in its flash. So the prediction takes the set
/// points that the robot reports, tick by tick, and is right for any shaping.
namespace astro::motor {

struct StepCourse {
  std::vector<double> time_s;  // from the first set point that is not 0
  std::vector<double> set_point_mps, observed_mps;
};
using StepCourses = std::array<StepCourse, 2>;  // left, right

/// Drives forward for `hold_s` at this speed, stops, and drives back. Returns the forward part up to the stop.
StepCourses measure_step(Bench& bench, robot::DriveSession& session, double speed_mps, double hold_s);

/// The set points of a jump with only an acceleration limit, one per tick.
StepCourse ramp(double speed_mps, double acceleration_mps2, double hold_s);

/// The predicted response of `loop` to the set points of a course, at the times of the course.
StepCourse predicted(const StepCourse& course, const motor::WheelLoop& loop);

motor::StepFigures figures(const StepCourse& course);

}  // namespace astro::motor
