#pragma once

#include "host/console/command_line.hpp"

/// The subcommands around ground truth and files of other programs. Each is a file named after it and adds itself to the
/// program, or to `truth`: options, examples in its footer, and a callback that does the work.
///
/// Output  data on stdout; everything else (progress, questions, warnings) on stderr.
/// Errors  a callback throws astro::Error with one sentence; main prints it and exits with 1. Wrong usage exits
///         with 2, Ctrl-C with 130.
namespace astro::commands {

void add_truth(console::Command app);
/// `truth watch`: what a tracker on the network sends, live.
void add_truth_watch(console::Command truth);
/// `truth film`: what a phone film of printed tags shows.
void add_truth_film(console::Command truth);
void add_inspect(console::Command app);
void add_tags(console::Command app);

}  // namespace astro::commands
