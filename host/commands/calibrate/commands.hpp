#pragma once

#include "host/console/command_line.hpp"

/// The subcommand that calibrates and judges. It adds itself to the program, and its own subcommands to itself: options,
/// examples in the footer, and a callback that does the work.
///
/// Output  data on stdout; everything else (progress, questions, warnings) on stderr.
/// Errors  a callback throws astro::Error with one sentence; main prints it and exits with 1. Wrong usage exits
///         with 2, Ctrl-C with 130.
namespace astro::commands {

void add_calibrate(console::Command app);

}  // namespace astro::commands
