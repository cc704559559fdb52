#pragma once

#include <array>

#include "host/formats/messages/std.hpp"

/// geometry_msgs, tf2_msgs and nav_msgs: metres, radians, quaternions.
namespace astro::ros2::msg {

struct Vector3 {
  double x = 0, y = 0, z = 0;

  static constexpr std::string_view kType = "geometry_msgs/msg/Vector3";
  static constexpr std::tuple kFields{Field{&Vector3::x, "x"}, Field{&Vector3::y, "y"},
                                      Field{&Vector3::z, "z"}};
  bool operator==(const Vector3&) const = default;
};

struct Point {
  double x = 0, y = 0, z = 0;

  static constexpr std::string_view kType = "geometry_msgs/msg/Point";
  static constexpr std::tuple kFields{Field{&Point::x, "x"}, Field{&Point::y, "y"}, Field{&Point::z, "z"}};
  bool operator==(const Point&) const = default;
};

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;

  static constexpr std::string_view kType = "geometry_msgs/msg/Quaternion";
  static constexpr std::tuple kFields{Field{&Quaternion::x, "x"}, Field{&Quaternion::y, "y"},
                                      Field{&Quaternion::z, "z"}, Field{&Quaternion::w, "w"}};
  bool operator==(const Quaternion&) const = default;
};

struct Pose {
  Point position;
  Quaternion orientation;

  static constexpr std::string_view kType = "geometry_msgs/msg/Pose";
  static constexpr std::tuple kFields{Field{&Pose::position, "position"},
                                      Field{&Pose::orientation, "orientation"}};
  bool operator==(const Pose&) const = default;
};

struct PoseStamped {
  Header header;
  Pose pose;

  static constexpr std::string_view kType = "geometry_msgs/msg/PoseStamped";
  static constexpr std::tuple kFields{Field{&PoseStamped::header, "header"},
                                      Field{&PoseStamped::pose, "pose"}};
  bool operator==(const PoseStamped&) const = default;
};

/// covariance: row by row of x, y, z and the rotations about them.
struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};

  static constexpr std::string_view kType = "geometry_msgs/msg/PoseWithCovariance";
  static constexpr std::tuple kFields{Field{&PoseWithCovariance::pose, "pose"},
                                      Field{&PoseWithCovariance::covariance, "covariance"}};
  bool operator==(const PoseWithCovariance&) const = default;
};

struct PoseWithCovarianceStamped {
  Header header;
  PoseWithCovariance pose;

  static constexpr std::string_view kType = "geometry_msgs/msg/PoseWithCovarianceStamped";
  static constexpr std::tuple kFields{Field{&PoseWithCovarianceStamped::header, "header"},
                                      Field{&PoseWithCovarianceStamped::pose, "pose"}};
  bool operator==(const PoseWithCovarianceStamped&) const = default;
};

struct Twist {
  Vector3 linear;
  Vector3 angular;

  static constexpr std::string_view kType = "geometry_msgs/msg/Twist";
  static constexpr std::tuple kFields{Field{&Twist::linear, "linear"}, Field{&Twist::angular, "angular"}};
  bool operator==(const Twist&) const = default;
};

struct TwistStamped {
  Header header;
  Twist twist;

  static constexpr std::string_view kType = "geometry_msgs/msg/TwistStamped";
  static constexpr std::tuple kFields{Field{&TwistStamped::header, "header"},
                                      Field{&TwistStamped::twist, "twist"}};
  bool operator==(const TwistStamped&) const = default;
};

struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};

  static constexpr std::string_view kType = "geometry_msgs/msg/TwistWithCovariance";
  static constexpr std::tuple kFields{Field{&TwistWithCovariance::twist, "twist"},
                                      Field{&TwistWithCovariance::covariance, "covariance"}};
  bool operator==(const TwistWithCovariance&) const = default;
};

struct Transform {
  Vector3 translation;
  Quaternion rotation;

  static constexpr std::string_view kType = "geometry_msgs/msg/Transform";
  static constexpr std::tuple kFields{Field{&Transform::translation, "translation"},
                                      Field{&Transform::rotation, "rotation"}};
  bool operator==(const Transform&) const = default;
};

struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;

  static constexpr std::string_view kType = "geometry_msgs/msg/TransformStamped";
  static constexpr std::tuple kFields{Field{&TransformStamped::header, "header"},
                                      Field{&TransformStamped::child_frame_id, "child_frame_id"},
                                      Field{&TransformStamped::transform, "transform"}};
  bool operator==(const TransformStamped&) const = default;
};

struct TFMessage {
  std::vector<TransformStamped> transforms;

  static constexpr std::string_view kType = "tf2_msgs/msg/TFMessage";
  static constexpr std::tuple kFields{Field{&TFMessage::transforms, "transforms"}};
  bool operator==(const TFMessage&) const = default;
};

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
