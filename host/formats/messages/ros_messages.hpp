#pragma once

#include <string_view>

#include "host/base/bytes.hpp"
#include "host/formats/cdr/type_description.hpp"
#include "host/formats/messages/geometry.hpp"

/// What recordings state of a message type, and how a message holds a planar pose: z = 0, orientation (0, 0, sin(theta/2),
/// cos(theta/2)).
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

inline constexpr std::string_view kOdomFrame = "odom", kFootprintFrame = "base_footprint",
                                  kBaseFrame = "base_link", kTruthFrame = "truth";

/// A pose on the floor with this heading. If the heading is NaN, so is the orientation.
msg::Pose planar_pose(double x_m, double y_m, double theta_rad);
/// The rotation about z, in (-pi, pi].
double heading_of(const msg::Quaternion& orientation);

/// Whether header.stamp can hold this time.
bool fits_stamp(std::int64_t time_us);

}  // namespace astro::ros2
