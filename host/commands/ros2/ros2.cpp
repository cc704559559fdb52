#include <fmt/format.h>

#include <memory>
#include <optional>
#include <vector>

#include "host/base/environment.hpp"
#include "host/commands/ros2/commands.hpp"
#include "host/commands/ros2/foxglove_options.hpp"
#include "host/commands/ros2/robot_driver.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/ros2/foxglove/foxglove_server.hpp"
#include "host/ros2/node/node.hpp"

namespace astro::commands {
namespace {

struct Ros2Options {
  RobotDriverOptions driver;
  FoxgloveOptions viewers;
  std::string node = "astrolabe", range, distribution;
  int domain = -1;  // that of the environment
};

ros2::GidSize gid_size(const Ros2Options& options) {
  const std::string distribution =
      options.distribution.empty() ? environment_variable("ROS_DISTRO") : options.distribution;
  const bool old = distribution == "foxy" || distribution == "galactic" || distribution == "humble";
  return old ? ros2::GidSize::humble : ros2::GidSize::iron_and_later;
}

const char* who_sees_it(const ros2::dds::Discovery& discovery) {
  switch (discovery.range) {
    case ros2::dds::Range::off:
      return "nobody sees it";
    case ros2::dds::Range::localhost:
      return discovery.peers.empty() ? "this computer only" : "this computer and the static peers";
    default:
      return "all computers of the network";
  }
}

void say_twin(const std::string& name) {
  console::say("WARNING: another node is called " + name +
               ", too: each answers what the other is asked; end one, or give it another --node-name or "
               "--namespace");
}

void run(Ros2Options& options) {
  if (options.viewers.wanted) take_viewers_port(options.driver.connection.port, options.viewers);
  ros2::dds::DiscoveryWishes wishes;
  if (options.domain >= 0) wishes.domain = options.domain;
  if (!options.range.empty()) wishes.range = ros2::dds::range_in(options.range);
  const ros2::dds::Discovery discovery = ros2::dds::discovery_from(wishes, environment_variable);
  const std::string& space = options.driver.node_namespace;
  const ros2::NodeName name{options.node, absolute_namespace(space)};
  const auto node = ros2::open_node({name, gid_size(options), say_twin}, discovery);
  console::say(fmt::format("node {} in domain {}: {}; Ctrl-C ends it", ros2::full_name(name),
                           discovery.domain, who_sees_it(discovery)));
  std::vector<ros2::Middleware*> middlewares{node.get()};
  std::optional<ros2::foxglove::FoxgloveServer> server;
  if (options.viewers.wanted) {
    middlewares.push_back(&server.emplace(foxglove_settings(options.viewers, options.node, space)));
    console::say(foxglove_announcement(options.viewers, server->port()));
  }
  drive_robot(middlewares, options.driver, options.node);
}

}  // namespace

void add_ros2(console::Command app) {
  const auto options = std::make_shared<Ros2Options>();
  const console::Command command =
      app.add_subcommand("ros2", "make the robot a node of ROS 2: odometry, /cmd_vel, services, parameters");
  add_robot_driver_options(command, options->driver);
  add_foxglove_options(command, options->viewers);
  command.add_option("--node-name", options->node, "name of the node")
      .type_name("NAME")
      .capture_default_str()
      .check([](const std::string& word) {
        return what_is_wrong({word, "/"});
      });
  command.add_option("--domain", options->domain, "domain of DDS (default: ROS_DOMAIN_ID,\notherwise 0)")
      .type_name("N")
      .check(console::whole(0, ros2::dds::kMostDomains));
  command
      .add_option(
          "--range", options->range,
          "which computers see the node (default: as\nROS_AUTOMATIC_DISCOVERY_RANGE or\nROS_LOCALHOST_ONLY "
          "say, otherwise localhost)")
      .type_name("off|localhost|subnet")
      .check([](const std::string& word) {
        return ros2::dds::range_in(word) ? "" : "'" + word + "' is none of off, localhost and subnet";
      });
  command
      .add_option("--distro", options->distribution,
                  "ROS 2 of the other nodes, humble or later: jazzy\n(default: ROS_DISTRO, otherwise jazzy)")
      .one_of({"humble", "jazzy"});
  console::examples(command, {"astrolabe ros2", "astrolabe ros2 --foxglove",
                              "astrolabe ros2 --port /dev/ttyACM0 --calibration calib.toml",
                              "astrolabe ros2 --namespace left --range subnet --rate 100"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
