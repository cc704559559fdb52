#include "host/truth/source/pose3.hpp"

#include <cmath>

namespace astro::truth {

bool is_possible(const Pose3& p) {
  constexpr double kFarthest_m = 1e4;
  const double length = std::hypot(std::hypot(p.qx, p.qy), std::hypot(p.qz, p.qw));
  // Written so that a NaN is refused as well.
  return std::abs(p.x_m) < kFarthest_m && std::abs(p.y_m) < kFarthest_m && std::abs(p.z_m) < kFarthest_m &&
         length > 0.5 && length < 2;
}

std::optional<UpAxis> up_axis_named(std::string_view name) {
  if (name == "y") return UpAxis::y;
  if (name == "z") return UpAxis::z;
  return std::nullopt;
}

Pose2 on_floor(const Pose3& p, UpAxis up) {
  const double theta_rad = wrapped_rad(2 * std::atan2(up == UpAxis::y ? p.qy : p.qz, p.qw));
  // A quarter turn about x brings y up: z then points the other way along the floor.
  return up == UpAxis::y ? Pose2{p.x_m, -p.z_m, theta_rad} : Pose2{p.x_m, p.y_m, theta_rad};
}

}  // namespace astro::truth
