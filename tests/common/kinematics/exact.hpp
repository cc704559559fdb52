#pragma once

#include <cmath>
#include <numbers>

#include "common/kinematics/pose.hpp"
#include "common/params/parameter_set.hpp"
#include "tests/common/fixed/seeded.hpp"

/// What the kinematics would be in real numbers, in long double (64 bits of mantissa), straight from the
/// integer parameters and without looking at common/kinematics.
namespace astro::tests {

using Real = long double;

inline constexpr Real kPi = std::numbers::pi_v<Real>;
/// What odometry carries to the next step: below 2^-29 m of way, below 2^-40 m of x and of y.
inline constexpr Real kNotYetGiven_m = 0x1p-29L + 2 * 0x1p-40L;

struct ExactGeometry {
  explicit ExactGeometry(const ParameterSet& set)
      : left_m(travel_m(set, Param::c_L)),
        right_m(travel_m(set, Param::c_R)),
        base_m(set.get(Param::b) * 1e-9L) {}

  Real left_m, right_m;  // of a wheel per count
  Real base_m;

 private:
  static Real travel_m(const ParameterSet& set, Param correction) {
    const Real c = std::ldexp(static_cast<Real>(set.get(correction)), -30);
    const Real gear = static_cast<Real>(set.get(Param::gear_numerator)) / set.get(Param::gear_denominator);
    return c * kPi * (set.get(Param::wheel_diameter) * 1e-9L) / (set.get(Param::counts_per_motor_rev) * gear);
  }
};

struct ExactPose {
  Real x_m = 0, y_m = 0, theta_rad = 0;
};

/// The exponential of SE(2): the pose after a constant twist that moves by `way_m` and turns by `turn_rad`.
inline ExactPose moved(const ExactPose& from, Real way_m, Real turn_rad) {
  const Real half = turn_rad / 2;
  const Real along = turn_rad == 0 ? 1 : std::sin(turn_rad) / turn_rad;
  const Real aside = turn_rad == 0 ? 0 : std::sin(half) * std::sin(half) / half;
  const Real c = std::cos(from.theta_rad), s = std::sin(from.theta_rad);
  return {from.x_m + way_m * (along * c - aside * s), from.y_m + way_m * (along * s + aside * c),
          from.theta_rad + turn_rad};
}

/// Heading straight from the running counts, so that no rounding adds up in it; position by exact arcs.
class ExactOdometry {
 public:
  explicit ExactOdometry(const ParameterSet& set, Real theta_rad = 0)
      : geometry_(set), start_rad_(theta_rad) {
    pose_.theta_rad = theta_rad;
  }

  void advance(int left_counts, int right_counts) {
    left_ += left_counts;
    right_ += right_counts;
    const Real turn_rad =
        (geometry_.right_m * right_counts - geometry_.left_m * left_counts) / geometry_.base_m;
    const Real way_m = (geometry_.right_m * right_counts + geometry_.left_m * left_counts) / 2;
    way_m_ += std::fabs(way_m);
    pose_ = moved(pose_, way_m, turn_rad);
    const Real turned_m =
        geometry_.right_m * static_cast<Real>(right_) - geometry_.left_m * static_cast<Real>(left_);
    pose_.theta_rad = start_rad_ + turned_m / geometry_.base_m;
  }

  const ExactPose& pose() const { return pose_; }
  Real way_m() const { return way_m_; }

 private:
  ExactGeometry geometry_;
  ExactPose pose_;
  Real start_rad_;
  Real way_m_ = 0;
  long long left_ = 0, right_ = 0;
};

inline Real metres(std::int64_t position) {
  return std::ldexp(static_cast<Real>(position), -Pose::kPositionBits);
}
inline Real radians(std::uint64_t turn_64) { return std::ldexp(2 * kPi * static_cast<Real>(turn_64), -64); }
/// The continuous heading.
inline Real heading_rad(const Pose& pose) { return 2 * kPi * pose.turns + radians(pose.theta.raw()); }

inline Real distance_m(const Pose& pose, const ExactPose& exact) {
  return std::hypot(metres(pose.x) - exact.x_m, metres(pose.y) - exact.y_m);
}

/// A set without a curvature effect that validate() takes, anywhere in what it takes.
inline ParameterSet random_robot(Seeded& random) {
  constexpr Param kGeometry[] = {Param::c_R,
                                 Param::c_L,
                                 Param::b,
                                 Param::wheel_diameter,
                                 Param::counts_per_motor_rev,
                                 Param::gear_numerator,
                                 Param::gear_denominator};
  while (true) {
    ParameterSet set;
    for (const Param id : kGeometry) {
      const ParamRow& row = param_row(id);
      // Half of the draws small: a uniform one hardly ever has a gear below 1000 or a wheel below 0.1 m.
      const std::int64_t wide = random.between(row.minimum_raw, row.maximum_raw);
      const std::int64_t narrow =
          row.minimum_raw + (wide - row.minimum_raw) / (1 + random.between(0, 10'000));
      set.set(id, static_cast<std::int32_t>((random.bits() & 1U) != 0 ? wide : narrow));
    }
    if (validate(set)) return set;
  }
}

/// What the curvature effect makes of the wheelbase, from its definition.
struct ExactEffect {
  explicit ExactEffect(const ParameterSet& set)
      : e(std::ldexp(static_cast<Real>(set.get(Param::e)), -30)), kappa0(set.get(Param::kappa0) * 1e-6L) {}

  /// The effective wheelbase over b at these wheel speeds, in any unit. At rest 1: a robot that stands turns about b.
  Real over_b(Real left, Real right) const {
    const Real s = std::fabs(right + left) / 2, d = std::fabs(right - left);
    return s == 0 ? 1 : 1 + e * kappa0 * s / (kappa0 * s + d);
  }
  /// The same for a body speed; `turning` is omega times b. Wheels of which d = |turning| (1 + x) have
  /// x = e kappa0 s / (kappa0 s + d), which is a quadratic equation.
  Real over_b_of_twist(Real v, Real turning) const {
    const Real k = kappa0 * std::fabs(v), d = std::fabs(turning);
    return k == 0 ? 1 : 1 + 2 * k * e / (k + d + std::sqrt((k + d) * (k + d) + 4 * d * k * e));
  }

  Real e, kappa0;
};

/// Any curvature effect that validate() takes; a third of them as of real tyres.
inline void draw_effect(ParameterSet& set, Seeded& random) {
  const auto draw = [&](Param id) {
    const ParamRow& row = param_row(id);
    return random.between32(row.minimum_raw, row.maximum_raw);
  };
  set.set(Param::e, draw(Param::e));
  const int choice = static_cast<int>(random.between(0, 2));
  if (choice == 0) set.set(Param::e, set.get(Param::e) / 5);
  set.set(Param::kappa0, choice == 2 ? draw(Param::kappa0) : random.between32(10'000, 500'000));
}

/// ASTRO with corrections as a calibration finds them.
inline ParameterSet calibrated_astro() {
  ParameterSet set;
  set.set(Param::c_R, 1'075'970'000);
  set.set(Param::c_L, 1'071'513'648);
  set.set(Param::b, 288'610'900);
  return set;
}

}  // namespace astro::tests
