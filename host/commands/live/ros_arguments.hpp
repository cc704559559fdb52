#pragma once

#include <string>
#include <vector>

#include "host/formats/cdr/names.hpp"
#include "host/formats/messages/parameters.hpp"
#include "host/live/driver/names.hpp"

namespace astro::commands {

/// What the ROS 2 arguments, which launch files pass after --ros-args, set for this node.
struct RosArguments {
  ros2::NodeName node;
  std::vector<live::Renaming> renamed;
  std::vector<ros2::msg::Parameter> parameters;  // each name once
};

/// Understands
///   -r, --remap [NODE:]FROM:=TO     topics, services; __node, __name and __ns. The first of several counts
///   -p, --param [NODE:]NAME:=VALUE  the value in YAML. The last of several counts, also of those in files
///   --params-file FILE              sections of this node's full name, where * is a word of it and ** any number of words
/// and ignores those for logging and security, which this node does not have, and those for other nodes.
///
/// `words`: without --ros-args. `otherwise`: the node's name if they do not set it. Throws console::WrongUsage for an
/// unknown or malformed word, and astro::Error naming the file if it cannot be read.
///
/// Source  rcl: arguments.c, remap.c; rcl_yaml_param_parser: parse.c
RosArguments ros_arguments(const std::vector<std::string>& words, const ros2::NodeName& otherwise);

}  // namespace astro::commands
