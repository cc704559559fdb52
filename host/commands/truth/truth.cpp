#include "host/commands/truth/commands.hpp"
#include "host/console/options.hpp"

namespace astro::commands {

void add_truth(console::Command app) {
  const console::Command command = app.add_subcommand("truth", "look at sources of ground truth");
  command.require_subcommand(1, 1);
  add_truth_watch(command);
  add_truth_film(command);
  console::examples(command, {"astrolabe truth watch vrpn://lab-pc:3883/ASTRO",
                              "astrolabe truth watch ros2:/vrpn_mocap/robot/pose",
                              "astrolabe truth film drives.mp4 --preview preview.png"});
}

}  // namespace astro::commands
