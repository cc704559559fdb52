#pragma once

#include <vector>

#include "host/commands/calibrate/commands.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/experiment/commands.hpp"
#include "host/commands/live/commands.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/selftest/commands.hpp"
#include "host/commands/simulate/commands.hpp"
#include "host/commands/truth/commands.hpp"
#include "host/console/command_line.hpp"

namespace astro::commands {

/// The subcommands in the order of --help, each under one heading.
inline void add_all(console::Command app) {
  using Add = void (*)(console::Command);
  struct Heading {
    const char* name;
    std::vector<Add> commands;
  };
  for (const Heading& heading : std::vector<Heading>{
           {"Start", {add_selftest, add_ports, add_info, add_flash, add_check_wiring, add_tune, add_params}},
           {"Drive", {add_drive, add_stop, add_pause, add_resume, add_monitor, add_faults, add_reboot}},
           {"Calibrate",
            {add_umbmark, add_calibrate, add_upload, add_record, add_compare, add_report, add_plan}},
           {"Your data", {add_inspect, add_export, add_truth, add_tags}},
           {"Live", {add_dashboard, add_ros2, add_serve}},
           {"Simulate", {add_sim, add_study}}})
    app.under(heading.name, [&] {
      for (const Add add : heading.commands) add(app);
    });
}

}  // namespace astro::commands
