#pragma once

#include "host/robot/client/client.hpp"
#include "host/robot/motion/paths.hpp"

/// Says on stderr where the robot's own limits make it slower than what was asked for: it clamps, and answers
/// nothing. Reads the robot's parameters only if something was asked for.
namespace astro::commands {

void say_what_is_clamped(robot::Client& client, const robot::Path& path);
void say_what_is_clamped(robot::Client& client, double v_mps, double omega_radps);

}  // namespace astro::commands
