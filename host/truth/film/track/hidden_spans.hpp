#pragma once

#include <vector>

#include "host/truth/film/track/film_sightings.hpp"
#include "host/truth/film/video/film_info.hpp"

namespace astro::film {

/// Where a film does not show the robot's tag, by the times of the pictures.
struct HiddenSpan {
  double from_s = 0, to_s = 0;
  /// The tag was last seen, or seen again, at the border of the picture. Otherwise something covers it.
  bool left_picture = false;
};

/// All that last longer than half a second: also before the tag is seen first, and after it is seen last.
std::vector<HiddenSpan> hidden_spans(const FilmSightings& seen, const FilmInfo& info);

}  // namespace astro::film
