#pragma once

#include <vector>

#include "host/truth/film/camera/floor_start.hpp"
#include "host/truth/film/tags/detector.hpp"
#include "host/truth/film/track/camera_motion.hpp"

namespace astro::film {

/// Looks at the floor tags again and again during a film: they show whether the camera stands, and their corners averaged over
/// many pictures are better than those of one.
///
/// Cost  2 ms for a look at six tags; 0.2 s more, but at most every two seconds, if most are not where they were.
class FloorWatch {
 public:
  explicit FloorWatch(const std::vector<SeenFloorTag>& tags);

  /// Takes a look if the last one is long enough ago.
  void take(const GrayFrame& frame);

  const std::vector<FloorLook>& looks() const { return looks_; }

 private:
  void search(const GrayFrame& frame, FloorLook& look);

  std::vector<SeenFloorTag> tags_;  // where they were seen last
  std::vector<FloorLook> looks_;
  TagDetector detector_;
  double last_search_s_ = 0;
  bool searched_ = false;
};

}  // namespace astro::film
