#include "host/truth/files/rotations.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

#include "host/base/text/degrees.hpp"

namespace astro::truth {
namespace {

/// The value of the first entry with this name.
template <class Value, std::size_t N>
std::optional<Value> looked_up(const std::pair<std::string_view, Value> (&table)[N], std::string_view name) {
  std::string lower(name.substr(0, 16));
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& [key, value] : table) {
    if (key == lower) return value;
  }
  return std::nullopt;
}

Quaternion turn_about(char axis, double angle_rad) {
  const double s = std::sin(angle_rad / 2), c = std::cos(angle_rad / 2);
  return {axis == 'X' ? s : 0, axis == 'Y' ? s : 0, axis == 'Z' ? s : 0, c};
}

}  // namespace

Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

Quaternion conjugate(const Quaternion& q) { return {-q.x, -q.y, -q.z, q.w}; }

Quaternion rotation_of(const Pose3& pose) { return {pose.qx, pose.qy, pose.qz, pose.qw}; }

void set_rotation(Pose3& pose, const Quaternion& q) {
  pose.qx = q.x;
  pose.qy = q.y;
  pose.qz = q.z;
  pose.qw = q.w;
}

void normalise(Pose3& pose) {
  const double length =
      std::sqrt(pose.qx * pose.qx + pose.qy * pose.qy + pose.qz * pose.qz + pose.qw * pose.qw);
  set_rotation(pose, {pose.qx / length, pose.qy / length, pose.qz / length, pose.qw / length});
}

Quaternion from_euler(std::string_view order, const std::array<double, 3>& angles_rad) {
  Quaternion q;
  for (const char axis : order) q = q * turn_about(axis, angles_rad[static_cast<std::size_t>(axis - 'X')]);
  return q;
}

bool is_euler_order(std::string_view text) {
  std::string sorted(text.substr(0, 4));
  std::sort(sorted.begin(), sorted.end());
  return sorted == "XYZ";
}

Quaternion from_rotation_vector(const std::array<double, 3>& v) {
  const double angle = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  const double scale = angle > 1e-12 ? std::sin(angle / 2) / angle : 0.5;
  return {scale * v[0], scale * v[1], scale * v[2], std::cos(angle / 2)};
}

double tilt_rad(const Quaternion& q, int axis) {
  const double about = axis == 0 ? q.x : axis == 1 ? q.y : q.z;
  return 2 * std::acos(std::min(1.0, std::hypot(about, q.w)));
}

}  // namespace astro::truth
