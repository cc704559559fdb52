#pragma once

#include "host/console/command_line.hpp"

/// The subcommand that makes a robot a node of ROS 2: a file named after it.
///
/// Output  what happens to the robot's link on stderr.
/// Errors  as host/commands/robot/commands.hpp. Ctrl-C ends with 130; a robot that was armed by the node is at rest then.
namespace astro::commands {

void add_ros2(console::Command app);

}  // namespace astro::commands
