#pragma once

#include <optional>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/wall/drive_against_wall.hpp"

/// The common scale of both wheels from gaps that somebody read: the robot stands flush, backs straight off, and the gap
/// between wall and front is what it has driven, along a slight arc if its wheels differ.
namespace astro::wall {

/// How far a robot with these factors has backed off square to the wall. Exact for an arc of constant curvature that begins
/// flush.
double backed_off_m(const WheelTravel& since_squaring, const calibration::WheelFactors& factors);

struct WallScale {
  double scale = 1, se = 0;  // absolute: (c_R + c_L) / 2
  int readings = 0;          // that were used
  int left_out = 0;          // readings that the others contradict
  /// How much more the readings scatter than their errors say (Birge's ratio), 1 or more; `se` includes it.
  double scatter = 1;

  /// The readings contradict each other, and nothing shows which of them is wrong.
  bool contradictory() const { return scatter > kContradictory; }
  static constexpr double kContradictory = 4;
};

/// `factors`: only their E_d and b / S are used. Returns nothing without a reading. The standard error contains slip, the
/// readings' own error, and that of the contact, which all readings share and which only gaps of different length can separate
/// from the scale. Readings that are four standard errors from the others are left out if most readings agree.
std::optional<WallScale> scale_of_gaps(const WallDrive& drive, const calibration::WheelFactors& factors,
                                       const WallNoise& noise);

/// The drive without the readings that most others contradict: those that scale_of_gaps takes.
WallDrive without_contradicted(const WallDrive& drive, const calibration::WheelFactors& factors,
                               const WallNoise& noise);

}  // namespace astro::wall
