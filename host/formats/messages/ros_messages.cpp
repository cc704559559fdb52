#include "host/formats/messages/ros_messages.hpp"

#include <cmath>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"

namespace astro::ros2 {
namespace {

constexpr std::int64_t kMicrosPerSecond = 1'000'000;
}  // namespace

const RosType& odometry_type() {
  static const RosType type = ros_type<msg::Odometry>();
  return type;
}
const RosType& pose_stamped_type() {
  static const RosType type = ros_type<msg::PoseStamped>();
  return type;
}

bool fits_stamp(std::int64_t time_us) {
  constexpr std::int64_t kEdge = (std::int64_t{1} << 31) * kMicrosPerSecond;
  return time_us >= -kEdge && time_us < kEdge;
}

msg::Pose planar_pose(double x_m, double y_m, double theta_rad) {
  const double flat = std::isnan(theta_rad) ? theta_rad : 0.0;
  return {{x_m, y_m, 0}, {flat, flat, std::sin(theta_rad / 2), std::cos(theta_rad / 2)}};
}

/// Swing-twist decomposition: 2 atan2(z, w), the same for q and -q.
double heading_of(const msg::Quaternion& q) {
  return 2 * (q.w < 0 ? std::atan2(-q.z, -q.w) : std::atan2(q.z, q.w));
}

}  // namespace astro::ros2
