#pragma once

#include <optional>
#include <string_view>

#include "host/base/bytes.hpp"
#include "host/recording/run/run.hpp"
#include "host/ros2/messages/geometry.hpp"
#include "host/ros2/types/type_description.hpp"

/// The samples of a run as ROS 2 messages. Times are the robot's clock in `header.stamp`, which takes +-2^31
/// s and whole nanoseconds. Poses are planar: z = 0, orientation (0, 0, sin(theta/2), cos(theta/2)).
namespace astro::ros2 {

/// A message type: its name and definition are written into the recording, so that viewers need nothing else.
struct RosType {
  std::string_view name;        // "nav_msgs/msg/Odometry"
  std::string_view definition;  // ros2msg: the .msg text, then those it refers to
};

/// Valid as long as the program.
template <Message M>
RosType ros_type() {
  return {M::kType, definition_of<M>()};
}

const RosType& odometry_type();      // nav_msgs/msg/Odometry
const RosType& pose_stamped_type();  // geometry_msgs/msg/PoseStamped
const RosType& wheel_counts_type();  // astrolabe_msgs/msg/WheelCounts: stamp, left, right

inline constexpr std::string_view kOdomFrame = "odom", kFootprintFrame = "base_footprint",
                                  kBaseFrame = "base_link", kTruthFrame = "truth";

/// Running encoder counts at one instant. No ROS type holds integer counts that wrap, so this type is our
/// own.
struct WheelCounts {
  std::int64_t time_us = 0;
  std::int32_t left = 0, right = 0;
};

/// On the floor, with this heading; NaN makes an orientation of NaNs.
msg::Pose planar_pose(double x_m, double y_m, double theta_rad);
/// The rotation about z, in (-pi, pi].
double heading_of(const msg::Quaternion& orientation);

/// Whether header.stamp can hold this time.
bool fits_stamp(std::int64_t time_us);

Bytes encode_odometry(const recording::OdometrySample& sample);  // all but the counts
Bytes encode_counts(const WheelCounts& counts);
/// A sample that is not valid becomes a pose of NaNs, which viewers draw as a gap; a valid one whose heading
/// is NaN becomes a position with an orientation of NaNs.
Bytes encode_truth(const recording::TruthSample& sample);

/// Nothing if the message is too short for its type. theta is in (-pi, pi]; orientations that are not planar
/// are reduced to their rotation about z, whatever the sign of the quaternion.
std::optional<recording::OdometrySample> decode_odometry(ByteView message);
std::optional<WheelCounts> decode_counts(ByteView message);
std::optional<recording::TruthSample> decode_truth(ByteView message);

}  // namespace astro::ros2
