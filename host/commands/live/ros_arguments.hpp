#pragma once

#include <string>
#include <vector>

#include "host/formats/cdr/names.hpp"
#include "host/formats/messages/parameters.hpp"
#include "host/live/driver/names.hpp"

namespace astro::commands {

/// What the arguments of ROS 2 say of this node, as launch files pass them behind --ros-args.
struct RosArguments {
  ros2::NodeName node;
  std::vector<live::Renaming> renamed;
  std::vector<ros2::msg::Parameter> parameters;  // each name once
};

/// Understands
///   -r, --remap [NODE:]FROM:=TO     topics, services; __node, __name and __ns. The first of several counts
///   -p, --param [NODE:]NAME:=VALUE  the value in YAML. The last of several counts, also of those in files
///   --params-file FILE              sections of this node's full name, where * is a word of it and ** any number of words
/// and passes over those that set up logging and security, of which this node has none. What is said of another node does not count.
///
/// `words`: without --ros-args. `otherwise`: the node's name where they do not say it. Throws console::WrongUsage for a word that
/// is none of these or not as it has to be, and astro::Error naming the file if it cannot be read.
///
/// Source  rcl: arguments.c, remap.c; rcl_yaml_param_parser: parse.c
RosArguments ros_arguments(const std::vector<std::string>& words, const ros2::NodeName& otherwise);

}  // namespace astro::commands
