#pragma once

#include <cstdint>

#include "common/kinematics/arc.hpp"
#include "common/kinematics/geometry.hpp"

namespace astro {

/// Dead reckoning from wheel counts.
///
/// The heading is an exact integer-linear function of the counts since the last set_pose or set_geometry. Its
/// only rounding is that of the two increments (2^-65 turn per count).
///
/// Errors  none. The caller must refuse steps outside ArcIntegrator's domain.
class Odometry {
 public:
  explicit Odometry(const Geometry& geometry) : geometry_(geometry) {}

  /// Signed counts since the last call, forward positive.
  void advance(std::int32_t left_counts, std::int32_t right_counts);

  const Pose& pose() const { return integrator_.pose(); }
  void set_pose(const Pose& pose) { integrator_.set_pose(pose); }
  void set_geometry(const Geometry& geometry) { geometry_ = geometry; }  // the pose stays where it is

 private:
  Geometry geometry_;
  ArcIntegrator integrator_;
};

}  // namespace astro
