#pragma once

#include "host/cli/command_line.hpp"

/// The subcommands of `astrolabe`. Each lives in a file of its own and adds itself to the app: options,
/// examples in its footer, and a callback that does the work.
///
/// Output  data on stdout; everything else (progress, questions, warnings) on stderr.
/// Errors  a callback throws astro::Error with one sentence; main prints it and exits with 1. Wrong usage
///         exits with 2, Ctrl-C with 130.
namespace astro::cli {

void add_sim(Command app);
void add_ports(Command app);
void add_info(Command app);
void add_params(Command app);
void add_drive(Command app);
void add_stop(Command app);
void add_pause(Command app);
void add_faults(Command app);
void add_reboot(Command app);
void add_flash(Command app);
void add_monitor(Command app);
void add_record(Command app);
void add_calibrate(Command app);
void add_upload(Command app);
void add_umbmark(Command app);
void add_compare(Command app);
void add_report(Command app);
void add_tune(Command app);
void add_check_wiring(Command app);
void add_study(Command app);
void add_plan(Command app);

}  // namespace astro::cli
