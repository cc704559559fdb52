#pragma once

#include <string>
#include <string_view>

/// Names of ROS 2, and what DDS calls them. A name is made of words with / between them; a word has letters, digits and
/// underscores and does not begin with a digit. A text that is no such name is refused with astro::Error, which says what is
/// wrong.
///
/// Source  rmw: validate_full_topic_name.c, validate_namespace.c, validate_node_name.c; design.ros2.org, "Topic and Service
///         name mapping to DDS".
namespace astro::ros2 {

inline constexpr std::size_t kLongestTopicName = 247, kLongestNamespace = 245, kLongestNodeName = 255;

/// Why a text is no name. Values: which name it is ("name", which a topic or a service has, "name of the node" or
/// "namespace"), and the text.
enum class NameProblem { malformed, too_long };

struct NodeName {
  std::string name;              // one word: "robot"
  std::string name_space = "/";  // "/" or absolute: "/hall/left"
};

/// Whether it is the full name of a topic or a service: "/mocap/robot/pose".
bool is_full_name(std::string_view name);

/// Returns the same node if both names are valid.
NodeName valid(NodeName node);

/// "/hall/left/robot"
std::string full_name(const NodeName& node);

/// The absolute name that `name` has in the node: "/odom" stays, "odom" lies in the node's namespace, "~/odom" below the node.
std::string resolved(std::string_view name, const NodeName& node);

/// Names on the wire. `name` is absolute.
std::string wire_name_of_topic(std::string_view name);     // "rt/odom" for "/odom"
std::string wire_name_of_requests(std::string_view name);  // "rq/armRequest" for "/arm"
std::string wire_name_of_replies(std::string_view name);   // "rr/armReply"

}  // namespace astro::ros2
