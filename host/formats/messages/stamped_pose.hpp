#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/formats/messages/ros_messages.hpp"

/// Poses in space in ROS 2 messages: of the five types in which trackers, filters and robots publish them, the time,
/// the frames and the pose. Covariances and twists are checked for length and left out.
namespace astro::ros2 {

struct StampedPose {
  std::int64_t time_ns = 0;        // header.stamp: the publisher's clock, 0 if it did not set one
  std::string frame, child_frame;  // child_frame: "" in messages that have none
  double x_m = 0, y_m = 0, z_m = 0;
  double qx = 0, qy = 0, qz = 0, qw = 1;  // as in the message: perhaps not of length 1, perhaps NaN

  bool operator==(const StampedPose&) const = default;
};

/// Whether poses_in() knows the message type: "geometry_msgs/msg/PoseStamped", PoseWithCovarianceStamped and
/// TransformStamped, "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage".
bool holds_poses(std::string_view type);

/// More transforms than any robot publishes in one message. In memory each takes twice its bytes, so a message is not
/// allowed to hold any number of them.
inline constexpr std::size_t kMostTransforms = 16'384;

/// The poses of one message; a TFMessage has up to kMostTransforms of them, the others one. Nothing if the message does
/// not fit its type, has a frame longer than kLongestName (cdr.hpp), or if holds_poses(type) is false.
std::optional<std::vector<StampedPose>> poses_in(std::string_view type, ByteView message);

const RosType& tf_message_type();

/// A TFMessage of these transforms. Precondition: times within 2^31 s.
Bytes encode_tf(const std::vector<StampedPose>& transforms);

/// Whether the name of a topic says that its poses come from a tracker: tracking systems by name, "tracker", and what
/// simulators call the true pose.
bool speaks_of_tracker(std::string_view topic);

/// Whether the robot itself may have computed the poses of a topic, as far as its name and type say: the topics of odometry,
/// of filters and of localisation, and the types that they publish, unless the name says the contrary. A "tracker" may as
/// well be a controller that tracks a path, so that word says nothing here.
bool may_be_estimate(std::string_view topic, std::string_view type);

}  // namespace astro::ros2
