#pragma once

#include <array>
#include <optional>
#include <string>

#include "host/truth/files/body_track.hpp"

/// Which way is up in a tracker's frame, as a drive on a floor shows it. No format states it.
namespace astro::truth {

using Direction3 = std::array<double, 3>;  // of length 1

/// "y", "-z", or "0.02,0.17,0.98" if it is more than 2.6 degrees from every axis.
std::string axis_text(const Direction3& direction);

struct UpAxisEvidence {
  /// Normal of the plane in which the positions lie; nothing if they lie on a line or at a point.
  std::optional<Direction3> by_positions;
  double plane_rms_m = 0;  // distance of the positions from their plane

  /// The axis about which the body turned; nothing if it hardly did, or if there are no rotations.
  std::optional<Direction3> by_rotations;

  double disagreement_rad = 0;  // between the two, if there are both; 0 to pi / 2
};

/// The largest component of both axes is positive, because positions and rotations cannot show whether an
/// axis points up or down. Uses valid samples only.
UpAxisEvidence find_up_axis(const BodyTrack& track);

/// A larger disagreement is no measurement error: positions and orientations are in different frames.
inline constexpr double kLargestDisagreement_rad = 0.09;  // 5 degrees

}  // namespace astro::truth
