#pragma once

#include <cstdint>

#include "common/kinematics/arc.hpp"
#include "common/kinematics/geometry.hpp"
#include "common/kinematics/twist.hpp"

namespace astro {

/// Dead reckoning from wheel counts.
///
/// With e = 0 the heading is an exact integer-linear function of the counts since the last set_pose or set_geometry.
/// Its only rounding is that of the two increments (2^-65 turn per count). With another e each step turns about the
/// effective wheelbase of the measured speeds: one tick's counts are too few to tell a curvature.
///
/// Errors  With e = 0 none. Else at most |e / (1 + e)| (5e-5 + w / |R - L|) of what is turned, where w is 3 um/s or
///         3 kappa0 um/s if that is more (EffectiveBase), and 2^-64 turn a step. Both are far less than e is known: with
///         e = 0.03 and wheels that differ by 100 mm/s, 15 urad in a turn. The caller must refuse steps outside
///         ArcIntegrator's domain.
class Odometry {
 public:
  explicit Odometry(const Geometry& geometry) : geometry_(geometry) {}

  /// Signed counts since the last call, forward positive. The speeds are those of the wheels now; with e = 0 they are
  /// not read.
  void advance(std::int32_t left_counts, std::int32_t right_counts, const WheelSpeeds& speeds);

  const Pose& pose() const { return integrator_.pose(); }
  void set_pose(const Pose& pose) { integrator_.set_pose(pose); }
  void set_geometry(const Geometry& geometry) { geometry_ = geometry; }  // the pose stays where it is

 private:
  // A function of its own, so that the tick of a robot with e = 0 costs one comparison more and not also the registers
  // that the rest would take from it.
  [[gnu::noinline]] void advance_about_effective_base(std::int32_t left_counts, std::int32_t right_counts,
                                                      const WheelSpeeds& speeds);
  std::int64_t travel(std::int32_t left_counts, std::int32_t right_counts) const;
  std::int64_t turn(std::int32_t left_counts, std::int32_t right_counts) const;

  Geometry geometry_;
  ArcIntegrator integrator_;
};

}  // namespace astro
