#pragma once

#include "host/console/command_line.hpp"

/// The subcommands that show a robot to others while it runs: in a web page, as ROS 2 messages to nodes and to viewers. Each is a
/// file named after it.
///
/// Output  what happens to the robot's link on stderr.
/// Errors  as host/commands/robot/commands.hpp. Ctrl-C and SIGTERM end with 0; a robot that was armed by the node or a page is at
///         rest then.
namespace astro::commands {

/// What launch files of ROS 2 put before their arguments, which end with -- or the command line.
inline constexpr const char* kRosArguments = "--ros-args";

void add_dashboard(console::Command app);
void add_ros2(console::Command app);
void add_serve(console::Command app);

}  // namespace astro::commands
