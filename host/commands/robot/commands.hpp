#pragma once

#include "host/console/command_line.hpp"

/// The subcommands that find a robot, ask it, set it up and load it. Each is a file named after it and adds itself to
/// the program: options, examples in its footer, and a callback that does the work.
///
/// Output  data on stdout; everything else (progress, questions, warnings) on stderr.
/// Errors  a callback throws astro::Error with one sentence; main prints it and exits with 1. Wrong usage exits
///         with 2, Ctrl-C with 130.
namespace astro::commands {

void add_ports(console::Command app);
void add_info(console::Command app);
void add_params(console::Command app);
void add_faults(console::Command app);
void add_reboot(console::Command app);
void add_flash(console::Command app);
void add_monitor(console::Command app);
void add_upload(console::Command app);

}  // namespace astro::commands
