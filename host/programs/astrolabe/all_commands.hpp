#pragma once

#include "host/commands/calibrate/commands.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/experiment/commands.hpp"
#include "host/commands/live/commands.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/simulate/commands.hpp"
#include "host/commands/truth/commands.hpp"
#include "host/console/command_line.hpp"

namespace astro::commands {

/// The subcommands in the order of --help.
inline void add_all(console::Command app) {
  for (const auto add :
       {add_umbmark, add_calibrate, add_upload,  add_record,  add_compare,      add_report, add_sim,
        add_ports,   add_info,      add_params,  add_drive,   add_stop,         add_pause,  add_resume,
        add_faults,  add_reboot,    add_flash,   add_monitor, add_check_wiring, add_tune,   add_plan,
        add_study,   add_export,    add_inspect, add_truth,   add_tags,         add_ros2,   add_serve})
    add(app);
}

}  // namespace astro::commands
