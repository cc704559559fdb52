#pragma once

#include "host/console/command_line.hpp"

/// The subcommands that turn the wheels of a robot and stop them. Each is a file named after it and adds itself to
/// the program, or to `drive`: options, examples in its footer, and a callback that does the work.
///
/// Output  data on stdout; everything else (progress, questions, warnings) on stderr.
/// Errors  a callback throws astro::Error with one sentence; main prints it and exits with 1. Wrong usage exits
///         with 2, Ctrl-C with 130.
namespace astro::commands {

void add_drive(console::Command app);
/// `drive teleop`: steering by keyboard.
void add_drive_teleop(console::Command drive);
void add_stop(console::Command app);
void add_pause(console::Command app);
void add_resume(console::Command app);
void add_check_wiring(console::Command app);
void add_tune(console::Command app);

}  // namespace astro::commands
