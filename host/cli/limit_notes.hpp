#pragma once

#include "host/link/client.hpp"
#include "host/link/paths.hpp"

/// Says on stderr where the robot's own limits make it slower than what was asked for: it clamps, and answers
/// nothing. Reads the robot's parameters only if something was asked for.
namespace astro::cli {

void say_what_is_clamped(link::Client& client, const link::Path& path);
void say_what_is_clamped(link::Client& client, double v_mps, double omega_radps);

}  // namespace astro::cli
