#pragma once

#include <cmath>

#include "host/base/error.hpp"
#include "host/truth/files/body_track.hpp"
#include "host/truth/floor/floor_path.hpp"
#include "host/truth/floor/lost_tracking.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

/// What holds for every track that a reader returns, and for what the floor makes of it.
inline void require_track_laws(truth::BodyTrack track) {
  for (std::size_t i = 0; i < track.samples.size(); ++i) {
    const truth::TrackedPose& sample = track.samples[i];
    require(i == 0 || sample.time_ns > track.samples[i - 1].time_ns, "times increase");
    require(!sample.valid || truth::is_possible(sample.pose), "a valid pose is possible");
    const truth::Pose3& p = sample.pose;
    const double length = std::hypot(std::hypot(p.qx, p.qy), std::hypot(p.qz, p.qw));
    require(!sample.valid || std::abs(length - 1) < 1e-9, "the quaternion of a valid pose has length 1");
  }
  const std::size_t samples = track.samples.size();
  truth::mark_lost(track);
  require(track.samples.size() == samples, "what is lost stays in the track");
  for (const recording::TruthSample& sample : truth::place_on_floor(track).samples)
    require(!sample.valid || (std::isfinite(sample.x_m) && std::isfinite(sample.y_m)),
            "valid points are finite");
}

/// Calls a reader; an Error is its right.
template <class Read>
void reading_track(Read read) {
  try {
    require_track_laws(read());
  } catch (const Error&) {
  }
}

}  // namespace astro::fuzz
