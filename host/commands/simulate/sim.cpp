#include <memory>

#include "host/commands/serving/served_robot_options.hpp"
#include "host/commands/simulate/commands.hpp"
#include "host/console/options.hpp"

namespace astro::commands {
namespace {

void run(const SimOptions& wanted) {
  SimOptions options = wanted;
  prepare(options, sim::Flash::kBytes);
  simulation::Server server(options.robot, options.mocap, options.server);
  serve(server, "a simulated robot");
}

}  // namespace

void add_sim(console::Command app) {
  const auto options = std::make_shared<SimOptions>();
  const console::Command command = app.add_subcommand(
      "sim", "run a simulated robot behind a pseudo terminal, with virtual cameras beside it");
  add_sim_options(command, *options);
  console::examples(command,
                    {"astrolabe sim", "astrolabe sim --pty /tmp/astro --fast",
                     "astrolabe sim --true-ed 1 --true-wheelbase 0.29 --slip 0 --flash astro.flash"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
