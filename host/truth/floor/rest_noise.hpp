#pragma once

#include <array>
#include <optional>

#include "host/truth/files/body_track.hpp"

/// The tracker's noise, as a body at rest shows it.
namespace astro::truth {

struct RestNoise {
  double rest_s = 0;             // how long the body stood, all rests together
  std::array<double, 3> sd_m{};  // per axis of the file
  double sd_rad = 0;             // of the rotation about the worst axis; 0 without rotations
};

/// Standard deviations within windows of half a second in which the body does not move more than its noise lets
/// expect, about the mean of each window, so that a slow drift of the tracker does not count.
/// Nothing if there is no second of rest.
///
/// A body that was glued to the same numbers (invalid samples) does not count as at rest.
std::optional<RestNoise> find_rest_noise(const BodyTrack& track);

}  // namespace astro::truth
