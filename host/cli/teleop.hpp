#pragma once

#include <CLI/CLI.hpp>

namespace astro::cli {

/// Adds `teleop` to `drive`: steering by keyboard.
void add_teleop(CLI::App& drive);

}  // namespace astro::cli
