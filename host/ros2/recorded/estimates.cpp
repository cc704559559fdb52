#include "host/ros2/recorded/estimates.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "host/ros2/recorded/stamped_pose.hpp"

namespace astro::ros2 {
namespace {

bool names_any(std::string_view topic, std::initializer_list<std::string_view> words) {
  std::string lower(topic);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::ranges::any_of(words,
                             [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

bool speaks_of_truth(std::string_view topic) {
  return names_any(topic, {"mocap", "vrpn", "optitrack", "vicon", "qualisys", "natnet", "truth"});
}

}  // namespace

bool speaks_of_tracker(std::string_view topic) {
  return speaks_of_truth(topic) || names_any(topic, {"tracker"});
}

bool may_be_estimate(std::string_view topic, std::string_view type) {
  if (speaks_of_truth(topic)) return false;
  return type == "nav_msgs/msg/Odometry" || type == tf_message_type().name ||
         type == "geometry_msgs/msg/PoseWithCovarianceStamped" ||
         names_any(topic, {"odom", "amcl", "slam", "ekf", "localization", "estimat", "filtered", "goal"});
}

}  // namespace astro::ros2
