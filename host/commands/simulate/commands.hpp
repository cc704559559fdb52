#pragma once

#include "host/console/command_line.hpp"

/// The subcommands around simulated robots. Each is a file named after it and adds itself to the program:
/// options, examples in its footer, and a callback that does the work.
///
/// Output  data on stdout; everything else (progress, questions, warnings) on stderr.
/// Errors  a callback throws astro::Error with one sentence; main prints it and exits with 1. Wrong usage exits
///         with 2, Ctrl-C with 130.
namespace astro::commands {

void add_sim(console::Command app);
void add_study(console::Command app);
void add_plan(console::Command app);

}  // namespace astro::commands
