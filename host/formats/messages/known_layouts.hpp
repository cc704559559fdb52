#pragma once

#include <memory>
#include <string_view>

#include "host/formats/cdr/message_layout.hpp"

namespace astro::ros2 {

/// The layouts of types whose recordings may lack a definition, as databases of ROS 2 did until Iron: single
/// numbers of std_msgs, and the counters of common robots. Null for any other type.
std::shared_ptr<const MessageLayout> known_layout(std::string_view type);

}  // namespace astro::ros2
