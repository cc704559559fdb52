#include "host/robot/motion/paths.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/robot/motion/drive_problem.hpp"

namespace astro::robot {

namespace {

/// value * scale to the nearest integer of type T.
template <class T>
T scaled(double value, double scale, const char* what) {
  const double steps = std::round(value * scale);
  // 2^63 is a double, 2^63 - 1 is not: compare from below.
  if (!(std::abs(steps) < std::ldexp(1.0, std::numeric_limits<T>::digits))) {
    throw Error(std::string(what) + " of " + to_text(value) + " is not possible",
                PathProblem::impossible_number, {what, to_text(value)});
  }
  return static_cast<T>(steps);
}

protocol::AddSegment segment(protocol::SegmentKind kind, double length_m, double turns, PathLimits limits) {
  if (limits.speed_mps < 0 || limits.yaw_rate_radps < 0) throw Error("a speed limit cannot be negative");
  return {.kind = kind,
          .tag = 0,
          .length_nm = scaled<std::int64_t>(length_m, 1e9, "a length in metres"),
          .angle = scaled<std::int64_t>(turns, 0x1p32, "an angle in turns"),
          .speed_umps = scaled<std::int32_t>(limits.speed_mps, 1e6, "a speed in m/s"),
          .yaw_rate_uradps = scaled<std::int32_t>(limits.yaw_rate_radps, 1e6, "a yaw rate in rad/s")};
}

}  // namespace

Path line(double length_m, PathLimits limits) {
  return {segment(protocol::SegmentKind::line, length_m, 0, limits)};
}

Path spin(double turns, PathLimits limits) {
  return {segment(protocol::SegmentKind::spin, 0, turns, limits)};
}

Path arc(double length_m, double turns, PathLimits limits) {
  return {segment(protocol::SegmentKind::arc, length_m, turns, limits)};
}

Path circle(double radius_m, double turns, Sense sense, PathLimits limits) {
  if (!(radius_m > 0) || !(turns > 0)) throw Error("a circle needs a positive radius and number of turns");
  return arc(2 * std::numbers::pi * radius_m * turns, sign_of(sense) * turns, limits);
}

Path square(double side_m, Sense sense, PathLimits limits) {
  if (!(side_m > 0)) throw Error("a square needs a positive side");
  Path path;
  for (int corner = 0; corner < 4; ++corner) {
    path.push_back(segment(protocol::SegmentKind::line, side_m, 0, limits));
    path.push_back(segment(protocol::SegmentKind::spin, 0, sign_of(sense) / 4, limits));
  }
  return path;
}

}  // namespace astro::robot
