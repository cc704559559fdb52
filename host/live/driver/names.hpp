#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/formats/messages/ros_messages.hpp"

namespace astro::live {

/// A topic or service that goes by another name; both are absolute.
struct Renaming {
  std::string from, to;
};

/// How a node's names differ from the usual ones.
struct NameChoices {
  std::vector<Renaming> renamed = {};            // if two rename one name, the first counts
  std::string odom_frame = {}, base_frame = {};  // "": the usual ones; not put into the namespace
};

/// The names of a node's topics, services and frames. Relative topic names ("odom") are in the node's namespace, absolute
/// ones ("/tf") are not. The frames of a node in a namespace begin with it, as those of diff_drive_controller do, so that
/// several robots share one /tf: "left/odom".
class Names {
 public:
  /// "", "left" or "/left/front".
  explicit Names(std::string_view node_namespace, NameChoices choices = {}) : choices_(std::move(choices)) {
    while (!node_namespace.empty() && node_namespace.front() == '/') node_namespace.remove_prefix(1);
    while (!node_namespace.empty() && node_namespace.back() == '/') node_namespace.remove_suffix(1);
    if (!node_namespace.empty()) prefix_ = std::string(node_namespace) + '/';
  }

  std::string absolute(std::string_view name) const {
    std::string full = name.starts_with('/') ? std::string(name) : '/' + prefix_ + std::string(name);
    for (const Renaming& each : choices_.renamed)
      if (each.from == full) return each.to;
    return full;
  }
  std::string frame(std::string_view name) const { return prefix_ + std::string(name); }
  std::string odom_frame() const {
    return choices_.odom_frame.empty() ? frame(ros2::kOdomFrame) : choices_.odom_frame;
  }
  /// The robot's frame in odometry, on the floor between its wheels. It may be the base's own frame.
  std::string base_frame() const {
    return choices_.base_frame.empty() ? frame(ros2::kFootprintFrame) : choices_.base_frame;
  }
  /// "" or "left/".
  const std::string& prefix() const { return prefix_; }

 private:
  std::string prefix_;
  NameChoices choices_;
};

}  // namespace astro::live
