#include "host/commands/shared/limit_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/console/console.hpp"
#include "host/robot/parameters/parameters.hpp"

namespace astro::commands {
namespace {

using protocol::AddSegment;

struct RequestedMotion {
  double speed_mps = 0, yaw_rate_radps = 0;
  double arc_yaw_rate_radps = 0;  // that the requested speed would need on the tightest arc
};

double radius_m(const AddSegment& arc) {
  const double angle_rad = 2 * std::numbers::pi * std::ldexp(static_cast<double>(arc.angle), -32);
  return std::abs(1e-9 * static_cast<double>(arc.length_nm) / angle_rad);
}

RequestedMotion requested_by(const robot::Path& path) {
  RequestedMotion requested;
  for (const AddSegment& segment : path) {
    const bool moves = segment.length_nm != 0, turns = segment.angle != 0;
    const double speed_mps = 1e-6 * segment.speed_umps;
    if (moves) requested.speed_mps = std::max(requested.speed_mps, speed_mps);
    if (turns) requested.yaw_rate_radps = std::max(requested.yaw_rate_radps, 1e-6 * segment.yaw_rate_uradps);
    if (moves && turns)
      requested.arc_yaw_rate_radps = std::max(requested.arc_yaw_rate_radps, speed_mps / radius_m(segment));
  }
  return requested;
}

/// A robot without this parameter has no such limit.
double limit_of(const robot::RemoteParameters& robot, const char* name) {
  return robot.find(name) == nullptr ? HUGE_VAL : robot.number(name);
}

void say_which_are_exceeded(const robot::RemoteParameters& robot, const RequestedMotion& requested) {
  constexpr double kStep = 1e-6;  // of the wire
  const double speed_mps = limit_of(robot, "speed_limit"), yaw_rate_radps = limit_of(robot, "yaw_rate_limit");
  if (requested.speed_mps > speed_mps + kStep)
    console::say(fmt::format(
        "the robot drives at {:g} m/s at most, its speed_limit, and not at the {:g} m/s asked for", speed_mps,
        requested.speed_mps));
  if (requested.yaw_rate_radps > yaw_rate_radps + kStep)
    console::say(fmt::format(
        "the robot turns at {:g} rad/s at most, its yaw_rate_limit, and not at the {:g} rad/s asked for",
        yaw_rate_radps, requested.yaw_rate_radps));
  // On an arc the robot obeys the tighter of both limits; the effect of speed_limit is reported above.
  const double arc_radps = requested.speed_mps > 0
                               ? requested.arc_yaw_rate_radps * std::min(1.0, speed_mps / requested.speed_mps)
                               : 0;
  if (arc_radps > yaw_rate_radps + kStep)
    console::say(fmt::format(
        "on the arc the robot is slower than asked for: its yaw_rate_limit is {:g} rad/s, and the arc would "
        "need {:.3g} rad/s",
        yaw_rate_radps, arc_radps));
}

void note_limits(robot::Client& client, const RequestedMotion& requested) {
  if (requested.speed_mps > 0 || requested.yaw_rate_radps > 0)
    say_which_are_exceeded(robot::RemoteParameters::fetch(client), requested);
}

}  // namespace

void note_limits(robot::Client& client, const robot::Path& path) { note_limits(client, requested_by(path)); }

void note_limits(robot::Client& client, double v_mps, double omega_radps) {
  note_limits(client, RequestedMotion{std::abs(v_mps), std::abs(omega_radps), 0});
}

}  // namespace astro::commands
