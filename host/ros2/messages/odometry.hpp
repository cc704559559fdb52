#pragma once

#include "host/ros2/messages/geometry.hpp"

namespace astro::ros2::msg {

/// The pose is in header.frame_id, the twist in child_frame_id.
struct Odometry {
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;

  static constexpr std::string_view kType = "nav_msgs/msg/Odometry";
  static constexpr std::tuple kFields{Field{&Odometry::header, "header"},
                                      Field{&Odometry::child_frame_id, "child_frame_id"},
                                      Field{&Odometry::pose, "pose"}, Field{&Odometry::twist, "twist"}};
  bool operator==(const Odometry&) const = default;
};

}  // namespace astro::ros2::msg
