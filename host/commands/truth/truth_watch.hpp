#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// `truth watch`: what a tracker on the network sends, live.
void add_truth_watch(console::Command truth);

}  // namespace astro::commands
