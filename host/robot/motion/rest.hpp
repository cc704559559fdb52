#pragma once

#include <functional>
#include <map>
#include <string>

#include "host/robot/client/client.hpp"

namespace astro::robot {

/// What a Resume means to a robot whose mode was not `paused`. A robot that still ramps to rest is in the mode of its drive.
inline constexpr const char* kNotPaused = "the robot was not paused, unless it was still coming to rest";

/// The time after which a robot that received a stop request no longer powers its motors: the longest ramp that the motion limits
/// allow, plus one second each for the jerk limit, for the wheels to settle (the robot's own deadline) and for the link, and at
/// least five seconds. `parameters`: the robot's numbers by name, in SI units; a limit that is missing is ignored.
microseconds longest_stop(const std::map<std::string, double>& parameters);

/// Waits until a robot that received a stop request no longer powers its motors, for longest_stop at most. A robot that still
/// drives then is disarmed, which opens its bridges at once, so it may roll on. `meanwhile` is called at least every 50 ms and may
/// itself ask the robot something, an emergency stop among it.
///
/// Returns false if it had to be disarmed.
/// Errors  all that Client::request throws, and `meanwhile`.
[[nodiscard]] bool wait_until_power_off(
    Client& client, const std::function<void()>& meanwhile = [] {});

/// Waits until the wheels have stopped although nothing brakes them: a robot whose bridges were opened by a
/// fault rolls on until friction stops it. Returns false if they still turn after two seconds. Ends this
/// client's telemetry.
/// Errors  all that Client::request throws; LinkLost if no telemetry comes.
[[nodiscard]] bool wait_until_wheels_stopped(Client& client);

}  // namespace astro::robot
