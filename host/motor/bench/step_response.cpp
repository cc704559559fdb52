#include "host/motor/bench/step_response.hpp"

#include <algorithm>
#include <cmath>

namespace astro::motor {
namespace {

constexpr double kTick_s = 1e-3;

// One set point for each tick. Telemetry may be sparser, so it is interpolated linearly: shaped set points are
// nearly piecewise linear.
std::vector<double> every_tick(const StepCourse& course) {
  std::vector<double> set_points;
  std::size_t i = 0;
  const int ticks = static_cast<int>(std::lround(course.time_s.back() / kTick_s));
  for (int tick = 0; tick <= ticks; ++tick) {
    const double t = tick * kTick_s;
    while (i + 1 < course.time_s.size() && course.time_s[i + 1] <= t + kTick_s / 2) ++i;
    const std::size_t next = std::min(i + 1, course.time_s.size() - 1);
    const double gap_s = course.time_s[next] - course.time_s[i];
    const double part = gap_s > 0 ? std::clamp((t - course.time_s[i]) / gap_s, 0.0, 1.0) : 0;
    set_points.push_back(course.set_point_mps[i] +
                         part * (course.set_point_mps[next] - course.set_point_mps[i]));
  }
  return set_points;
}

StepCourse cut(const std::vector<Moment>& moments, std::size_t begin, std::size_t end, std::size_t side) {
  StepCourse course;
  const auto starts = [&](std::size_t i) {
    return moments[i].set_point_mps[0] != 0 || moments[i].set_point_mps[1] != 0;
  };
  while (begin < end && !starts(begin)) ++begin;
  for (std::size_t i = begin; i < end; ++i) {
    course.time_s.push_back(moments[i].time_s - moments[begin].time_s);
    course.set_point_mps.push_back(moments[i].set_point_mps[side]);
    course.observed_mps.push_back(moments[i].observed_mps[side]);
  }
  return course;
}

void hold(Bench& bench, robot::DriveSession& session, double speed_mps, double hold_s) {
  const double end_s = bench.fresh().time_s + hold_s;
  while (bench.now().time_s < end_s) bench.velocity(session, speed_mps);
}

}  // namespace

StepCourses measure_step(Bench& bench, robot::DriveSession& session, double speed_mps, double hold_s) {
  session.stop();
  bench.fresh();
  const std::size_t begin = bench.moments().size();
  hold(bench, session, speed_mps, hold_s);
  const std::size_t end = bench.moments().size();
  session.stop();
  hold(bench, session, -speed_mps, hold_s);
  session.stop();
  return {cut(bench.moments(), begin, end, 0), cut(bench.moments(), begin, end, 1)};
}

StepCourse ramp(double speed_mps, double acceleration_mps2, double hold_s) {
  StepCourse course;
  for (double t = 0; t <= hold_s; t += kTick_s) {
    course.time_s.push_back(t);
    course.set_point_mps.push_back(std::min(speed_mps, acceleration_mps2 * (t + kTick_s)));
  }
  course.observed_mps.resize(course.time_s.size());
  return course;
}

StepCourse predicted(const StepCourse& course, const motor::WheelLoop& loop) {
  StepCourse result = course;
  if (course.time_s.empty()) return result;
  const auto answer = motor::predict(loop, every_tick(course));
  for (std::size_t i = 0; i < course.time_s.size(); ++i) {
    const auto tick = static_cast<std::size_t>(std::lround(course.time_s[i] / kTick_s));
    result.observed_mps[i] = answer[std::min(tick, answer.size() - 1)].observed_mps;
  }
  return result;
}

motor::StepFigures figures(const StepCourse& course) {
  return motor::step_figures(course.time_s, course.set_point_mps, course.observed_mps);
}

}  // namespace astro::motor
