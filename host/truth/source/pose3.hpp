#pragma once

#include <optional>
#include <string_view>

#include "host/base/pose2.hpp"

/// Poses in space as trackers give them, and the part of them that a robot on a floor needs.
namespace astro::truth {

/// A body's pose in the tracker's frame: metres, and a quaternion that need not be exactly of length 1.
struct Pose3 {
  double x_m = 0, y_m = 0, z_m = 0;
  double qx = 0, qy = 0, qz = 0, qw = 1;

  bool operator==(const Pose3&) const = default;
};

/// Whether a body can have this pose. Trackers send zeros for a body that they have lost, and a damaged
/// message has anything: positions beyond 10 km, quaternions that are no rotation, NaN.
bool is_possible(const Pose3& pose);

/// Which axis of the tracker's frame points up. No protocol says it: cameras are set up either way.
enum class UpAxis { y, z };
std::optional<UpAxis> up_axis_named(std::string_view name);

/// The pose on the floor, in a right-handed frame whose z points up. The heading, in [-pi, pi], is the turn about
/// the up axis that is left when the tilt is taken away (swing and twist), so a small tilt does not change it, and
/// q and -q have the same.
///
/// Precondition  is_possible(pose)
Pose2 on_floor(const Pose3& pose, UpAxis up);

}  // namespace astro::truth
