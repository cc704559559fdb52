#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/options.hpp"
#include "host/cli/sim_options.hpp"

namespace astro::cli {
namespace {

void run(const SimOptions& wanted) {
  SimOptions options = wanted;
  prepare(options, sim::Flash::kBytes);
  simulator::MocapConfig mocap;
  mocap.seed = options.robot.seed;
  simulator::Server server(options.robot, mocap, options.server);
  serve(server, "a simulated robot");
}

}  // namespace

void add_sim(Command app) {
  const auto options = std::make_shared<SimOptions>();
  const Command command = app.add_subcommand(
      "sim", "run a simulated robot behind a pseudo terminal, with virtual cameras beside it");
  add_sim_options(command, *options);
  examples(command, {"astrolabe sim", "astrolabe sim --pty /tmp/astro --fast",
                     "astrolabe sim --true-ed 1 --true-wheelbase 0.29 --slip 0 --flash astro.flash"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::cli
