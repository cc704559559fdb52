#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "host/base/environment.hpp"
#include "host/commands/live/commands.hpp"
#include "host/commands/live/foxglove_options.hpp"
#include "host/commands/live/robot_driver.hpp"
#include "host/commands/live/ros_arguments.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/live/foxglove/foxglove_server.hpp"
#include "host/live/ros2/node.hpp"

namespace astro::commands {
namespace {

struct Ros2Options {
  RobotDriverOptions driver;
  FoxgloveOptions viewers;
  std::string node = "astrolabe", range, distribution, cmd_vel_type;
  int domain = -1;  // that of the environment
  std::vector<std::string> ros_arguments;
};

bool others_are_of_humble(const Ros2Options& options) {
  const std::string distribution =
      options.distribution.empty() ? environment_variable("ROS_DISTRO") : options.distribution;
  return distribution == "foxy" || distribution == "galactic" || distribution == "humble";
}

/// The default message type of the other nodes' navigation and controllers (host/live/README.md lists them).
live::CommandType cmd_vel_type(const Ros2Options& options) {
  const auto& names = live::kCommandTypeNames;
  const auto chosen = std::ranges::find(names, options.cmd_vel_type);
  if (chosen != names.end()) return static_cast<live::CommandType>(chosen - names.begin());
  return others_are_of_humble(options) ? live::CommandType::twist : live::CommandType::twist_stamped;
}

const char* who_sees_it(const dds::Discovery& discovery) {
  switch (discovery.range) {
    case dds::Range::off:
      return "nobody sees it";
    case dds::Range::localhost:
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

void say_foreign_type(const std::string& topic, const std::string& type) {
  std::string sentence = fmt::format("WARNING: a node publishes {} as {}, which is not taken", topic, type);
  for (const auto word : {name(live::CommandType::twist_stamped), name(live::CommandType::twist)})
    if (type == fmt::format("geometry_msgs/msg/{}", word))
      sentence += fmt::format(": --cmd-vel {} takes it", word);
  console::say(sentence);
}

void run(Ros2Options& options) {
  if (options.viewers.wanted) take_listen_port(options.driver.connection.port, options.viewers);
  dds::DiscoveryWishes wishes;
  if (options.domain >= 0) wishes.domain = options.domain;
  if (!options.range.empty()) wishes.range = dds::range_in(options.range);
  const dds::Discovery discovery = dds::discovery_from(wishes, environment_variable);
  options.driver.cmd_vel_type = cmd_vel_type(options);
  const RosArguments ros =
      ros_arguments(options.ros_arguments, {options.node, absolute_namespace(options.driver.node_namespace)});
  const ros2::NodeName& name = ros.node;
  options.driver.node_namespace = name.name_space;
  options.driver.names.renamed = ros.renamed;
  take_parameters(ros.parameters, options.driver);
  const auto gid_size = others_are_of_humble(options) ? live::GidSize::humble : live::GidSize::iron_and_later;
  const auto node = live::open_node({name, gid_size, say_twin, say_foreign_type}, discovery);
  console::say(fmt::format("node {} in domain {}: {}; Ctrl-C ends it", ros2::full_name(name),
                           discovery.domain, who_sees_it(discovery)));
  std::vector<live::Middleware*> middlewares{node.get()};
  std::optional<foxglove::FoxgloveServer> server;
  if (options.viewers.wanted) {
    middlewares.push_back(
        &server.emplace(foxglove_settings(options.viewers, name.name, names_of(options.driver))));
    console::say(foxglove_announcement(options.viewers, server->port()));
  }
  drive_robot(middlewares, options.driver, name.name);
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
      .check(console::whole(0, dds::kMostDomains));
  command
      .add_option(
          "--range", options->range,
          "which computers see the node (default: as\nROS_AUTOMATIC_DISCOVERY_RANGE or\nROS_LOCALHOST_ONLY "
          "say, otherwise localhost)")
      .type_name("off|localhost|subnet")
      .check([](const std::string& word) {
        return dds::range_in(word) ? "" : "'" + word + "' is none of off, localhost and subnet";
      });
  command
      .add_option(
          "--cmd-vel", options->cmd_vel_type,
          "type of /cmd_vel; with both, ROS 2's own tools\nneither record nor show the topic (default:\n"
          "TwistStamped; of Humble Twist)")
      .one_of({live::kCommandTypeNames.begin(), live::kCommandTypeNames.end()});
  command
      .add_option("--distro", options->distribution,
                  "ROS 2 of the other nodes, humble or later: jazzy\n(default: ROS_DISTRO, otherwise jazzy)")
      .one_of({"humble", "jazzy"});
  command
      .add_option(
          kRosArguments, options->ros_arguments,
          "as launch files pass them, up to a -- or the end:\n-r FROM:=TO, -r __node:=NAME, -r __ns:=/NAME,\n"
          "-p NAME:=VALUE, --params-file FILE")
      .type_name("... [--]")
      .one_each_time();
  console::examples(command, {"astrolabe ros2", "astrolabe ros2 --foxglove",
                              "astrolabe ros2 --ros-args -r __ns:=/left -r /tf:=tf -p publish_rate:=30",
                              "astrolabe ros2 --port /dev/ttyACM0 --calibration calib.toml",
                              "astrolabe ros2 --namespace left --range subnet --rate 100"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
