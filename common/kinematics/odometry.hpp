#pragma once

#include <cstdint>

#include "common/kinematics/geometry.hpp"
#include "common/kinematics/pose.hpp"

namespace astro {

/// Moves a pose along exact arcs, T <- T * exp(travel, 0, turn): a steady turn gives the same pose at any
/// rate.
///
/// Domain  |travel| < 4 m and |turn| < 1/4 turn a step; the robot refuses encoder steps beyond.
/// Errors  heading none, ever: it is an integer sum. Position: what the Q43 sine and the 32-bit chord leave,
///         below 2e-10 of the way. Nothing is rounded per step: travel below the 2^-29 m that a product can
///         hold and position below 2^-40 m are carried to the next step.
/// Cost    constant, one sine and cosine, no division; callable from the control tick.
/// Source  Sola, Deray, Atchuthan, arXiv:1812.01537v9, eqs. 156-158: the chord of an arc of length s and
/// angle a is
///         s * sin(a/2) / (a/2), and points along the mean of both headings.
class ArcIntegrator {
 public:
  /// travel in 2^-61 m, turn in 2^-64 turn.
  void advance(std::int64_t travel, std::int64_t turn);

  const Pose& pose() const { return pose_; }
  /// Goes on from here; nothing of the past remains.
  void set_pose(const Pose& pose) {
    *this = ArcIntegrator{};
    pose_ = pose;
  }

 private:
  Pose pose_;
  std::uint32_t remainder_ = 0;            // 2^-61 m, less than 2^-29 m: travel not yet in the position
  std::uint32_t x_rest_ = 0, y_rest_ = 0;  // 2^-72 m, less than 2^-40 m: position not yet in the pose
};

/// Dead reckoning from wheel counts.
///
/// The heading is an exact integer-linear function of the counts since the last set_pose or set_geometry: it
/// holds no rounding at all beyond the one of the two increments (2^-65 turn per count).
///
/// Errors  none. Steps beyond ArcIntegrator's domain are the caller's to refuse.
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
