#include "host/ros2/driver/pose_message.hpp"

#include <cmath>

#include "host/base/error.hpp"
#include "host/ros2/recorded/ros_messages.hpp"

namespace astro::ros2 {

using calibration::Symmetric3;

namespace {

Symmetric3 on_floor(const std::array<double, 36>& c) { return {c[0], c[1], c[5], c[7], c[11], c[35]}; }

/// No direction has a negative variance: the principal minors are not negative, but for rounding.
bool is_covariance(const Symmetric3& p) {
  const auto minor = [](double a, double b, double ab) { return a * b * (1 + 1e-9) >= ab * ab; };
  return p.xx >= 0 && p.yy >= 0 && p.tt >= 0 && minor(p.xx, p.yy, p.xy) && minor(p.xx, p.tt, p.xt) &&
         minor(p.yy, p.tt, p.yt) && determinant(p) >= -1e-9 * p.xx * p.yy * p.tt;
}

}  // namespace

PlanarPose planar(const std::optional<msg::PoseWithCovarianceStamped>& message, const std::string& frame) {
  if (!message) throw Error("the message is damaged");
  if (message->header.frame_id != frame)
    throw Error("it is in the frame '" + message->header.frame_id + "', not in '" + frame + "'");
  const msg::Quaternion& q = message->pose.pose.orientation;
  const double length = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
  const msg::Point& at = message->pose.pose.position;
  if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(length))
    throw Error("it holds NaN or infinity");
  if (length < 1e-3) throw Error("its orientation has the length 0");
  const Symmetric3 covariance = on_floor(message->pose.covariance);
  // Written so that NaN is refused, too.
  if (!is_covariance(covariance)) throw Error("its covariance of x, y and yaw is not one");
  return {at.x, at.y, heading_of(q), covariance};
}

}  // namespace astro::ros2
