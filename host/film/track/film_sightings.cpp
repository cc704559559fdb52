#include "host/film/track/film_sightings.hpp"

#include <algorithm>
#include <cmath>

#include "host/film/camera/floor_start.hpp"
#include "host/film/picture/corner_refinement.hpp"
#include "host/film/picture/detector.hpp"
#include "host/film/picture/frame_stream.hpp"

namespace astro::film {
namespace {

using Eigen::Vector2d;

constexpr double kLeastGap_s = 0.9e-3;    // of a thousand pictures a second; closer ones have wrong times
constexpr double kCoarse = 2, kFine = 1;  // factor by which the picture is reduced
constexpr double kCoarseEnough_px = 54;   // a tag with longer sides is surely found at half the resolution
constexpr int kPatience = 5;              // pictures after a loss that are each searched as a whole
constexpr int kCoarseEvery = 3, kFineEvery = 15;
constexpr double kLookEvery_s = 0.2, kSearchEvery_s = 2;  // time between looks at the floor tags

/// Follows the robot's tag from picture to picture. Searches around the expected place, and in the whole
/// picture after the tag was lost.
///
/// Cost  3 ms for a picture while the tag is seen; after it was lost at most 50 ms on average (1080p).
class RobotTracker {
 public:
  explicit RobotTracker(int id) : id_(id) {}

  /// The tag in the next picture, with fine corners; nothing if it does not show.
  std::optional<RefinedTag> find(const GrayFrame& frame);

  /// Sets where the tag is now, if that is known.
  void expect(const TagCorners& corners) { last_ = corners; }

  /// Whether the last picture had the robot's id at two places.
  bool twice() const { return twice_; }

 private:
  std::optional<TagCorners> detected(const GrayFrame& frame, const Window& window, double decimate);
  std::optional<TagCorners> nearby(const GrayFrame& frame);
  std::optional<TagCorners> anywhere(const GrayFrame& frame);

  int id_;
  TagDetector detector_;
  std::optional<TagCorners> last_;
  Eigen::Vector2d step_{0, 0};  // px from picture to picture
  int misses_ = 0;
  bool twice_ = false;
};

Window around(const GrayFrame& frame, const Vector2d& middle, double reach_px) {
  const auto low = [](double from, int size) { return std::clamp(static_cast<int>(from), 0, size - 1); };
  const int left = low(middle.x() - reach_px, frame.width), top = low(middle.y() - reach_px, frame.height);
  const int right = low(middle.x() + reach_px, frame.width),
            bottom = low(middle.y() + reach_px, frame.height);
  return {left, top, right - left + 1, bottom - top + 1};
}

std::optional<TagCorners> RobotTracker::detected(const GrayFrame& frame, const Window& window,
                                                 double decimate) {
  constexpr int kLeast_px = 24;
  if (window.width < kLeast_px || window.height < kLeast_px) return std::nullopt;
  std::optional<TagCorners> best;
  double nearest = 0;
  int places = 0;
  for (const DetectedTag& tag : detector_.detect(frame, window, decimate)) {
    if (tag.id != id_) continue;
    ++places;
    const double far = last_ ? (center_of(tag.corners) - center_of(*last_)).norm() : 0;
    if (best && far >= nearest) continue;
    best = tag.corners;
    nearest = far;
  }
  twice_ = twice_ || places > 1;
  return best;
}

std::optional<TagCorners> RobotTracker::nearby(const GrayFrame& frame) {
  const double size = longest_side(*last_);
  const Vector2d middle = center_of(*last_) + step_;
  const Window window = around(frame, middle, 2 * size + 0.5 * size * std::min(misses_, 6));
  if (shortest_side(*last_) > kCoarseEnough_px)
    if (auto found = detected(frame, window, kCoarse)) return found;
  return detected(frame, window, kFine);
}

std::optional<TagCorners> RobotTracker::anywhere(const GrayFrame& frame) {
  const bool small = last_ && shortest_side(*last_) < kCoarseEnough_px;
  if (misses_ % kFineEvery == (small ? 0 : kFineEvery - 1)) return detected(frame, whole_of(frame), kFine);
  if (misses_ < kPatience || misses_ % kCoarseEvery == 0) return detected(frame, whole_of(frame), kCoarse);
  return std::nullopt;
}

std::optional<RefinedTag> RobotTracker::find(const GrayFrame& frame) {
  twice_ = false;
  std::optional<TagCorners> found = last_ ? nearby(frame) : std::nullopt;
  if (!found) found = anywhere(frame);
  if (!found) {
    ++misses_;
    step_.setZero();
    return std::nullopt;
  }
  if (last_ && misses_ == 0) step_ = center_of(*found) - center_of(*last_);
  misses_ = 0;
  last_ = *found;
  return refine_corners(frame, *found);
}

/// Looks at the floor tags repeatedly during a film. They show whether the camera is at rest, and their
/// corners averaged over many pictures are better than those of one.
///
/// Cost  2 ms for a look at six tags; 0.2 s more, but at most every two seconds, if most are not where they were.
class FloorWatch {
 public:
  explicit FloorWatch(const std::vector<SeenFloorTag>& tags);

  /// Takes a look if enough time has passed since the last one.
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
  if (!looks_.empty() && frame.pts_s - looks_.back().pts_s < kLookEvery_s) return;
  FloorLook look{frame.pts_s, std::vector<std::optional<TagCorners>>(tags_.size())};
  std::size_t seen = 0;
  for (std::size_t i = 0; i < tags_.size(); ++i) {
    const auto fine = refine_corners(frame, tags_[i].corners);
    if (!fine) continue;
    look.tags[i] = fine->corners;
    ++seen;
  }
  // A person who walks by hides one or two tags. If most are gone, the camera was moved.
  if (2 * seen < tags_.size() && (!searched_ || frame.pts_s - last_search_s_ > kSearchEvery_s))
    search(frame, look);
  looks_.push_back(std::move(look));
}

/// Notes the picture's time; false if it is not later than the one before.
bool note_time(FilmSightings& all, double pts_s) {
  if (all.pictures == 0) all.first_s = all.last_s = pts_s;
  const double gap_s = pts_s - all.last_s;
  if (++all.pictures > 1 && gap_s < kLeastGap_s) {
    ++all.unordered;
    return false;
  }
  if (gap_s > all.longest_gap_s) {
    all.longest_gap_s = gap_s;
    all.gap_at_s = all.last_s;
  }
  all.last_s = pts_s;
  return true;
}

}  // namespace

FilmSightings watch_film(const std::filesystem::path& film, const FilmInfo& info, int robot_id,
                         const FloorSurvey& survey, const Progress& progress) {
  FrameStream stream(film, info, FrameStream::Pictures::all);
  RobotTracker tracker(robot_id);
  if (!survey.robot.empty()) tracker.expect(survey.robot.front().corners);
  FloorWatch watch(survey.floor);
  FilmSightings all;
  all.two_robots_s = survey.two_robots_s;
  GrayFrame frame;
  while (stream.next(frame)) {
    if (!note_time(all, frame.pts_s)) continue;
    watch.take(frame);
    if (const auto tag = tracker.find(frame))
      all.robot.push_back({frame.pts_s, tag->corners, tag->edge_width_px});
    if (tracker.twice() && !all.two_robots_s) all.two_robots_s = frame.pts_s;
    if (progress) progress(info.part(frame.pts_s - all.first_s));
  }
  if (progress) progress(1);  // throws after an interrupt, which also ends the decoder
  all.looks = watch.looks();
  all.complaint = stream.complaint();
  return all;
}

}  // namespace astro::film
