#pragma once

#include "host/truth/live/stamps.hpp"
#include "host/truth/source/pose3.hpp"

namespace astro::truth {

/// One pose of the tracked body as it came from the network.
struct Sighting {
  Stamp stamp;
  Pose3 pose;
  bool tracked = true;  // as far as the tracker says
};

}  // namespace astro::truth
