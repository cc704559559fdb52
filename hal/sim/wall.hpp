#pragma once

#include <cstdint>

#include "hal/sim/chassis.hpp"
#include "hal/sim/config.hpp"

/// A straight wall in the simulated world, and what it does to a robot that runs into it. The body is a rectangle, so only its
/// four corners can touch a straight wall. A corner that is inside the wall is pushed out:
///
///   N = max(0, k depth + c d(depth)/dt)     across the wall, outward
///   F = -min(c_t |s|, mu N) sign(s)         along it, against the corner's sliding speed s
///
/// so one corner alone turns a robot that is driven on until the second one touches as well, and pressing evenly it stands
/// flush. What is left then comes from the wall's unevenness and from how differently the wheels press.
///
/// The force acts for a tick as it was at the tick's start. The energy that a spring gains by that, k v dt / 2 for each metre of
/// depth, is taken back by damping as long as c > k dt / 2 (5 N s/m against the 100 of a usual front).
///
/// Units   metres, newtons, radians; body frame: x forward, y left, origin midway between the wheels
namespace astro::sim {

/// The forces of the wall on the body: along its heading, and the moment about the point midway between the wheels.
struct WallForce {
  double forward_N = 0;
  double turning_Nm = 0;
  double pressing_N = 0;  // on the wall, both corners together
};

class Wall {
 public:
  Wall(const WallConfig& config, const Body& body, std::uint64_t seed);

  /// For a robot at this pose with this speed of its centre and this turning rate. A front with play settles anew once all corners
  /// have been 3 cm from the wall.
  WallForce force(const Pose& pose, double v_mps, double omega_radps);

  /// From the middle of the front to the wall, square to the wall: what a ruler shows. Negative inside it.
  double front_gap_m(const Pose& pose) const;
  /// The same for the middle of the rear.
  double rear_gap_m(const Pose& pose) const;

  /// The heading of a robot whose front, as it settled last, is flush with the wall if both are even.
  double flush_heading_rad() const;

 private:
  double gap_m(double x_m, double y_m) const;
  double height_m(double along_m) const;
  double gap_at_m(const Pose& pose, double ahead_m) const;
  void settle_front();

  WallConfig config_;
  Body body_;
  std::uint64_t seed_;
  double out_x_, out_y_;  // unit vector across the wall, into the room
  std::uint64_t touches_ = 0;
  bool touched_ = false;  // since the front settled
  double front_turned_rad_ = 0;
};

}  // namespace astro::sim
