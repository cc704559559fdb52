#include "host/truth/film/track/robot_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace astro::film {
namespace {

using Eigen::Vector2d;

constexpr double kCoarse = 2, kFine = 1;  // by which the picture is reduced
constexpr double kCoarseEnough_px = 54;   // the shortest side that is surely found in half the resolution
constexpr int kPatience = 5;  // pictures in which a lost tag is looked for in the whole picture at once
constexpr int kCoarseEvery = 3, kFineEvery = 15;

Window around(const GrayFrame& frame, const Vector2d& middle, double reach_px) {
  const auto low = [](double from, int size) { return std::clamp(static_cast<int>(from), 0, size - 1); };
  const int left = low(middle.x() - reach_px, frame.width), top = low(middle.y() - reach_px, frame.height);
  const int right = low(middle.x() + reach_px, frame.width),
            bottom = low(middle.y() + reach_px, frame.height);
  return {left, top, right - left + 1, bottom - top + 1};
}

}  // namespace

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

}  // namespace astro::film
