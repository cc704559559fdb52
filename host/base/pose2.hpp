#pragma once

#include <cmath>
#include <numbers>

/// Poses in the plane, the group SE(2), and the motions of constant velocity that join them.
///
/// Frames  A pose says where a frame b is, seen from a frame a: T_ab. Then T_ac = T_ab * T_bc, and a point
///         p_b of frame b is p_a = T_ab * p_b. The axes are x forward and y left; theta is counter-clockwise.
/// Units   metres, radians. Headings are added and subtracted as they are, because whole turns count;
///         wrapped() removes them.
/// Errors  none. A NaN reaches only what depends on it: a pose without a heading has a position in any frame.
/// Cost    constant; at most two sines and two cosines each.
/// Source  Sola, Deray, Atchuthan, A micro Lie theory for state estimation in robotics, arXiv:1812.01537v9,
///         the appendix on SE(2); names as in manif's SE2, which wraps its angles.
namespace astro {

/// The same angle in [-pi, pi]. NaN stays NaN.
inline double wrapped_rad(double angle_rad) { return std::remainder(angle_rad, 2 * std::numbers::pi); }

/// sin(a) / a: the chord of an arc that turns by 2 a, over its length. Below the limit the first term of the
/// series that is left out, a^4 / 120, is less than the rounding.
inline double sinc(double a) { return std::abs(a) < 1e-4 ? 1 - a * a / 6 : std::sin(a) / a; }

struct Point2 {
  double x_m = 0, y_m = 0;

  /// About the origin.
  Point2 turned(double angle_rad) const {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    return {c * x_m - s * y_m, s * x_m + c * y_m};
  }
};

struct Twist2;

struct Pose2 {
  double x_m = 0, y_m = 0, theta_rad = 0;

  Pose2 inverse() const {
    const Point2 at = Point2{-x_m, -y_m}.turned(-theta_rad);
    return {at.x_m, at.y_m, -theta_rad};
  }
  /// `other` seen from here, T_ab^-1 * T_ac = T_bc. The positions are subtracted first, so that poses which
  /// are close to each other and far from their origin keep their digits.
  Pose2 between(const Pose2& other) const {
    const Point2 at = Point2{other.x_m - x_m, other.y_m - y_m}.turned(-theta_rad);
    return {at.x_m, at.y_m, other.theta_rad - theta_rad};
  }
  /// The motion that ends here and turns by exactly theta: exp(log(T)) = T. A motion by whole turns ends at
  /// its start. So if the end is elsewhere and theta approaches whole turns, the length grows without bound.
  Twist2 log() const;
};

/// A constant velocity times how long it lasts; x and y in the moving frame. y is 0 for wheels that do not
/// slip.
struct Twist2 {
  double x_m = 0, y_m = 0, theta_rad = 0;

  /// Where the motion ends, seen from where it began: the exact arc. Its chord points halfway between both
  /// headings.
  Pose2 exp() const {
    const double half_rad = theta_rad / 2, ratio = sinc(half_rad);
    const Point2 at = Point2{ratio * x_m, ratio * y_m}.turned(half_rad);
    return {at.x_m, at.y_m, theta_rad};
  }
};

inline Twist2 Pose2::log() const {
  const double half_rad = theta_rad / 2, ratio = sinc(half_rad);
  const Point2 chord = Point2{x_m, y_m}.turned(-half_rad);
  return {chord.x_m / ratio, chord.y_m / ratio, theta_rad};
}

inline Point2 operator*(const Pose2& pose, const Point2& point) {
  const Point2 at = point.turned(pose.theta_rad);
  return {pose.x_m + at.x_m, pose.y_m + at.y_m};
}

inline Pose2 operator*(const Pose2& outer, const Pose2& inner) {
  const Point2 at = outer * Point2{inner.x_m, inner.y_m};
  return {at.x_m, at.y_m, outer.theta_rad + inner.theta_rad};
}

/// The same pose with its heading in [-pi, pi].
inline Pose2 wrapped(const Pose2& pose) { return {pose.x_m, pose.y_m, wrapped_rad(pose.theta_rad)}; }

/// a - b by coordinate, the heading in [-pi, pi]: an error in the frame in which both are seen. The motion
/// from b to a is b.between(a).
inline Pose2 difference(const Pose2& a, const Pose2& b) {
  return wrapped({a.x_m - b.x_m, a.y_m - b.y_m, a.theta_rad - b.theta_rad});
}

/// The pose of a sample that has more than a pose.
template <class Sample>
Pose2 pose_of(const Sample& sample) {
  return {sample.x_m, sample.y_m, sample.theta_rad};
}

}  // namespace astro
