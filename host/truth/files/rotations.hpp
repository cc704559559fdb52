#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "host/truth/source/pose3.hpp"

/// The ways in which trackers write a rotation, as quaternions.
namespace astro::truth {

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

Quaternion operator*(const Quaternion& a, const Quaternion& b);
Quaternion conjugate(const Quaternion& q);
Quaternion rotation_of(const Pose3& pose);
void set_rotation(Pose3& pose, const Quaternion& q);

/// Makes the quaternion's length 1. Precondition: is_possible(pose).
void normalise(Pose3& pose);

/// Three turns about the axes of the body itself, one after the other ("YXZ": first about y).
/// `angles_rad` are those about x, y and z, whatever the order. Precondition: is_euler_order(order).
Quaternion from_euler(std::string_view order, const std::array<double, 3>& angles_rad);
bool is_euler_order(std::string_view text);  // each of X, Y and Z once

/// A rotation about the vector's direction by its length. The length need not be wrapped: Vicon lets it run
/// to a whole turn.
Quaternion from_rotation_vector(const std::array<double, 3>& vector_rad);

/// How far the rotation leans away from a turn about axis 0, 1 or 2 (x, y, z), 0 to pi.
double tilt_rad(const Quaternion& q, int axis);

}  // namespace astro::truth
