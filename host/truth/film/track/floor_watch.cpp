#include "host/truth/film/track/floor_watch.hpp"

#include <algorithm>

#include "host/truth/film/tags/corner_refinement.hpp"

namespace astro::film {
namespace {

constexpr double kEvery_s = 0.2, kSearchEvery_s = 2;

}  // namespace

FloorWatch::FloorWatch(const std::vector<SeenFloorTag>& tags) : tags_(tags) {}

void FloorWatch::search(const GrayFrame& frame, FloorLook& look) {
  searched_ = true;
  last_search_s_ = frame.pts_s;
  for (const DetectedTag& found : detector_.detect(frame, whole_of(frame), 1))
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      if (tags_[i].id != found.id || look.tags[i]) continue;
      const auto fine = refine_corners(frame, found.corners);
      if (!fine) continue;
      look.tags[i] = fine->corners;
      tags_[i].corners = fine->corners;
    }
}

void FloorWatch::take(const GrayFrame& frame) {
  if (!looks_.empty() && frame.pts_s - looks_.back().pts_s < kEvery_s) return;
  FloorLook look{frame.pts_s, std::vector<std::optional<TagCorners>>(tags_.size())};
  std::size_t seen = 0;
  for (std::size_t i = 0; i < tags_.size(); ++i) {
    const auto fine = refine_corners(frame, tags_[i].corners);
    if (!fine) continue;
    look.tags[i] = fine->corners;
    ++seen;
  }
  // Somebody who walks by hides one or two; if most are gone, the camera was moved.
  if (2 * seen < tags_.size() && (!searched_ || frame.pts_s - last_search_s_ > kSearchEvery_s))
    search(frame, look);
  looks_.push_back(std::move(look));
}

}  // namespace astro::film
