#pragma once

#include <string>
#include <string_view>

namespace astro::ros2 {

/// Whether it is the full name of a topic: "/mocap/robot/pose", tokens of letters, digits and underscores that do not begin with
/// a digit.
bool is_topic_name(std::string_view name);

/// The name of a topic on the wire: "rt/odom" for "/odom".
std::string dds_topic_name(std::string_view topic);

}  // namespace astro::ros2
