#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

void add_truth_film(console::Command truth);

}  // namespace astro::commands
