#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/commands/shared/connection.hpp"
#include "host/console/command_line.hpp"
#include "host/formats/cdr/names.hpp"
#include "host/live/driver/driver.hpp"

/// Shared by the commands that publish a robot as ROS 2 messages, over any middleware.
namespace astro::commands {

struct RobotDriverOptions {
  ConnectionOptions connection;
  std::string node_namespace;
  double rate_hz = 50, cmd_vel_timeout_s = 0.5;
  bool cmd_vel_after_stop = false;
  live::CommandType cmd_vel_type = live::CommandType::both;  // viewers publish either
  std::filesystem::path calibration;
  live::NameChoices names;
  bool odom_tf = true, use_sim_time = false;
  std::vector<ros2::msg::Parameter> robot_parameters;
};

live::Names names_of(const RobotDriverOptions& options);

/// Applies what a launch file sets: parameters of the node replace options, others may be the robot's. Throws
/// console::WrongUsage for a value that is not possible.
void take_parameters(const std::vector<ros2::msg::Parameter>& parameters, RobotDriverOptions& options);

/// "/left" for "left" and "/left".
std::string absolute_namespace(const std::string& space);

/// One sentence if ROS 2 would refuse a node of this name in this namespace, or "".
std::string what_is_wrong(const ros2::NodeName& node);

/// --port, --baud, --namespace, --rate, --cmd-vel-timeout, --cmd-vel-after-stop and --calibration.
void add_robot_driver_options(console::Command command, RobotDriverOptions& options);

/// Serves a robot on these middlewares until Ctrl-C, and throws Interrupted then; a robot that was armed by others through them
/// is at rest and disarmed. `node`: the name under which it reports. `beside` is called again and again, and must not wait.
/// Throws astro::Error if the calibration cannot be used.
void drive_robot(
    const std::vector<live::Middleware*>& middlewares, const RobotDriverOptions& options,
    const std::string& node, const std::function<void(live::Driver&)>& beside = [](live::Driver&) {});

}  // namespace astro::commands
