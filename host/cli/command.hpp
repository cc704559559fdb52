#pragma once

#include <CLI/CLI.hpp>

/// The subcommands of `astrolabe`. Each lives in a file of its own and adds itself to the app: options,
/// examples in its footer, and a callback that does the work.
///
/// Output  data on stdout; everything else (progress, questions, warnings) on stderr.
/// Errors  a callback throws astro::Error with one sentence; main prints it and exits with 1. Wrong usage
/// exits
///         with 2, Ctrl-C with 130.
namespace astro::cli {

void add_sim(CLI::App& app);
void add_ports(CLI::App& app);
void add_info(CLI::App& app);
void add_params(CLI::App& app);
void add_drive(CLI::App& app);
void add_stop(CLI::App& app);
void add_pause(CLI::App& app);
void add_faults(CLI::App& app);
void add_reboot(CLI::App& app);
void add_flash(CLI::App& app);
void add_monitor(CLI::App& app);
void add_record(CLI::App& app);
void add_calibrate(CLI::App& app);
void add_upload(CLI::App& app);
void add_umbmark(CLI::App& app);
void add_compare(CLI::App& app);
void add_report(CLI::App& app);
void add_tune(CLI::App& app);
void add_check_wiring(CLI::App& app);
void add_study(CLI::App& app);
void add_plan(CLI::App& app);

}  // namespace astro::cli
