#pragma once

#include <cstdint>

#include "common/control/trapezoid.hpp"
#include "common/fixed/fixed.hpp"
#include "common/kinematics/arc.hpp"
#include "common/kinematics/twist.hpp"
#include "common/params/parameter_set.hpp"

namespace astro {

/// Follows segments: a reference pose moves along the path exactly as planned, and the odometry's error to it
/// corrects the set point.
///
///   v = v_ref + k_along e_along
///   omega = omega_ref + k_heading e_theta + k_cross v_ref e_cross
///
/// The errors are taken in the reference's frame. Segments that follow one another are one path: the next
/// begins where the reference has arrived, not where the robot is, so errors do not add up around a square.
///
/// The correction changes much more slowly than a tick, so it need not be computed in each: the ticks in between hold it, and move
/// the reference afterwards in one step.
///
/// Cost    constant, no division; callable from the control tick. With a correction on an arc two sines and cosines, in a spin one, on
///         a line none; without one a step of the profile.
/// Source  Kanayama et al., ICRA 1990, linearised.
class PathFollower {
 public:
  struct Command {
    BodyTwist twist;
    BodyTwist acceleration;  // of the reference, 1e-6 m/s^2 and 1e-6 rad/s^2
  };

  void set_gains(const ParameterSet& set);

  /// Begins a path at `pose`, where the robot stands.
  void begin_path(const Pose& pose);
  /// Goes on with a path that was left off for a while: the last correction is out of date.
  void resume_path() { correction_ = {}; }
  /// Begins the next segment of the path.
  void begin(const Trapezoid& profile) {
    profile_ = profile;
    moved_ = {};
  }

  /// Makes the reference come to rest on the path, for a pause.
  void cut_short() { profile_.cut_short(); }
  const Trapezoid& profile() const { return profile_; }

  /// One tick. `corrects`: computes the correction anew.
  Command advance(const Pose& actual, bool corrects = true);

  /// The reference has arrived; the robot may still be settling.
  bool arrived() const { return profile_.done() && !behind(); }
  /// At the last correction, which a drive makes every five ticks, the robot was within half a millimetre and a milliradian of the
  /// reference.
  bool close() const { return close_; }
  /// At the last correction: the distance of the reference to the left of the robot, 1e-6 m, and the reference's
  /// heading minus the robot's, 1e-6 rad.
  std::int32_t cross_track_um() const { return cross_um_; }
  std::int32_t heading_error_urad() const { return heading_urad_; }
  /// The reference at the last correction.
  const Pose& reference() const { return reference_.pose(); }

 private:
  /// The reference has not been moved to where the profile is.
  bool behind() const {
    return moved_.travel != profile_.given().travel || moved_.turn != profile_.given().turn;
  }
  void move_reference();
  const SinCos& heading();
  BodyTwist correction(const Pose& actual, std::int32_t v_ref_umps);

  Q16 k_along_, k_cross_, k_heading_;
  Trapezoid profile_;
  ArcIntegrator reference_;
  Trapezoid::Step moved_;  // how much of the profile the reference has
  // Of the angle heading_of_. A line, and a reference that has arrived, need no other.
  SinCos heading_{0, std::int64_t{1} << SinCos::kFractionBits};
  Angle heading_of_;
  BodyTwist last_, correction_;
  std::int32_t cross_um_ = 0, heading_urad_ = 0;
  bool close_ = false;
};

}  // namespace astro
