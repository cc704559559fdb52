#pragma once

#include "host/robot/client/client.hpp"
#include "host/robot/motion/paths.hpp"

/// Notices on stderr where the robot's own limits make it slower than requested, because the robot reduces a
/// requested speed without saying so. Reads the robot's parameters only if a speed was requested.
namespace astro::commands {

void note_limits(robot::Client& client, const robot::Path& path);
void note_limits(robot::Client& client, double v_mps, double omega_radps);

}  // namespace astro::commands
