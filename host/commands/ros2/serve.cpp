#include <memory>
#include <optional>

#include "host/commands/ros2/commands.hpp"
#include "host/commands/ros2/foxglove_options.hpp"
#include "host/commands/ros2/robot_driver.hpp"
#include "host/commands/ros2/truth_topic.hpp"
#include "host/commands/shared/truth_option.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/ros2/foxglove/foxglove_server.hpp"

namespace astro::commands {
namespace {

struct ServeOptions {
  RobotDriverOptions driver;
  FoxgloveOptions viewers;
  TruthOption truth{"none", {}, {}};
};

void run(ServeOptions& options) {
  if (!options.viewers.wanted) throw console::WrongUsage("serve what? --foxglove serves viewers");
  take_viewers_port(options.driver.connection.port, options.viewers);
  ConnectionOptions& connection = options.driver.connection;
  if (connection.port.empty() && options.truth.source == "sim") connect(connection);  // finds the only robot
  std::unique_ptr<truth::Source> source;
  if (options.truth.source != "none") source = open_truth(options.truth, connection.port);
  TruthTopic::Open open_again;  // trackers are found again by themselves
  if (options.truth.source == "sim")
    open_again = [option = options.truth, port = connection.port] { return open_truth(option, port); };
  ros2::foxglove::FoxgloveServer server(
      foxglove_settings(options.viewers, "Astrolabe", names_of(options.driver)));
  std::optional<TruthTopic> truth;
  if (source) truth.emplace(server, names_of(options.driver), std::move(source), open_again);
  console::say(foxglove_announcement(options.viewers, server.port()));
  drive_robot({&server}, options.driver, "astrolabe", [&](ros2::Driver& driver) {
    if (truth) truth->step(driver);
  });
}

}  // namespace

void add_serve(console::Command app) {
  const auto options = std::make_shared<ServeOptions>();
  const console::Command command =
      app.add_subcommand("serve", "show the robot live in Foxglove: pose, model, wheels, state, parameters");
  add_foxglove_options(command, options->viewers);
  add_robot_driver_options(command, options->driver);
  command
      .add_option("--truth", options->truth.source,
                  "ground truth beside odometry, as truth: sim,\nvrpn://HOST/BODY, natnet://HOST/BODY "
                  "or\nros2:/TOPIC")
      .type_name("SOURCE")
      .check(truth_source({"sim", "none"}));
  console::examples(command, {"astrolabe serve --foxglove", "astrolabe serve --foxglove --port 8766",
                              "astrolabe serve --foxglove --truth sim --rate 200",
                              "astrolabe serve --foxglove --allow-commands --listen 192.168.1.7:8765"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
