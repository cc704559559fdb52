#pragma once

#include <string>
#include <string_view>

namespace astro::ros2 {

/// The names of a node's topics, services and frames. Those of topics that are relative ("odom") are in the node's namespace,
/// those that are absolute ("/tf") are not. The frames of a node in a namespace begin with it, as those of
/// diff_drive_controller do, so that several robots share one /tf: "left/odom".
class Names {
 public:
  /// "", "left" or "/left/front".
  explicit Names(std::string_view node_namespace) {
    while (!node_namespace.empty() && node_namespace.front() == '/') node_namespace.remove_prefix(1);
    while (!node_namespace.empty() && node_namespace.back() == '/') node_namespace.remove_suffix(1);
    if (!node_namespace.empty()) prefix_ = std::string(node_namespace) + '/';
  }

  std::string absolute(std::string_view name) const {
    return name.starts_with('/') ? std::string(name) : '/' + prefix_ + std::string(name);
  }
  std::string frame(std::string_view name) const { return prefix_ + std::string(name); }
  /// "" or "left/".
  const std::string& prefix() const { return prefix_; }

 private:
  std::string prefix_;
};

}  // namespace astro::ros2
