#include "host/film/track/camera_motion.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "host/base/order_statistics.hpp"

namespace astro::film {
namespace {

using Eigen::Vector2d;

constexpr double kSmooth_s = 2.5;     // to either side
constexpr double kOutlier_px = 1;     // a corner that is further from the median is of a half hidden tag
constexpr double kWorthIt_px = 0.25;  // motions below this are noise of the codec

/// The mean of the values near the median.
double robust_mean(const std::vector<double>& values) {
  const double middle = median_of(values);
  std::vector<double> far;
  for (const double value : values) far.push_back(std::abs(value - middle));
  const double limit = std::max(3 * 1.4826 * median_of(far), 1e-3);
  double sum = 0, count = 0;
  for (const double value : values)
    if (std::abs(value - middle) <= limit) sum += value, ++count;
  return sum / count;
}

TagCorners mean_of(const std::vector<FloorLook>& looks, std::size_t tag, const TagCorners& otherwise) {
  TagCorners mean = otherwise;
  for (std::size_t corner = 0; corner < 4; ++corner)
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      std::vector<double> values;
      for (const FloorLook& look : looks)
        if (look.tags[tag]) values.push_back((*look.tags[tag])[corner][axis]);
      if (!values.empty()) mean[corner][axis] = robust_mean(values);
    }
  return mean;
}

/// A corner's mean place and its offset from it.
struct Offset {
  Vector2d place, off;
};

std::vector<Offset> offsets_of(const FloorLook& look, const std::vector<TagCorners>& means) {
  std::vector<double> x, y;
  std::vector<Offset> all;
  for (std::size_t tag = 0; tag < means.size(); ++tag) {
    if (!look.tags[tag]) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      all.push_back({means[tag][i], (*look.tags[tag])[i] - means[tag][i]});
      x.push_back(all.back().off.x());
      y.push_back(all.back().off.y());
    }
  }
  if (all.empty()) return all;
  const Vector2d middle(median_of(x), median_of(y));
  std::erase_if(all, [&](const Offset& one) { return (one.off - middle).norm() > kOutlier_px; });
  return all;
}

/// Estimates the shift, and also turn and growth if the corners are far enough apart.
std::optional<PictureMotion> motion_at(const FloorLook& look, const std::vector<TagCorners>& means,
                                       const Vector2d& about) {
  constexpr double kShort_px = 200;  // too short a baseline to show a turn
  const std::vector<Offset> offsets = offsets_of(look, means);
  if (offsets.size() < 4) return std::nullopt;
  PictureMotion motion;
  motion.pts_s = look.pts_s;
  motion.about_px = about;
  Vector2d middle(0, 0), mean(0, 0);
  const auto count = static_cast<double>(offsets.size());
  for (const Offset& one : offsets) {
    middle += one.place / count;
    mean += one.off / count;
  }
  double turn = 0, growth = 0, squares = 0;
  for (const Offset& one : offsets) {
    const Vector2d arm = one.place - middle, off = one.off - mean;
    growth += arm.dot(off);
    turn += arm.x() * off.y() - arm.y() * off.x();
    squares += arm.squaredNorm();
  }
  motion.shift_px = mean;
  if (squares > count * kShort_px * kShort_px) {
    motion.turn_rad = turn / squares;
    motion.growth = growth / squares;
    motion.about_px = middle;
    motion.shift_px = motion.at(about);
    motion.about_px = about;
  }
  return motion;
}

std::vector<PictureMotion> smoothed(const std::vector<PictureMotion>& raw) {
  std::vector<PictureMotion> course = raw;
  std::size_t from = 0, to = 0;
  for (PictureMotion& motion : course) {
    while (raw[from].pts_s < motion.pts_s - kSmooth_s) ++from;
    while (to < raw.size() && raw[to].pts_s <= motion.pts_s + kSmooth_s) ++to;
    std::vector<double> x, y, turn, growth;
    for (std::size_t i = from; i < to; ++i) {
      x.push_back(raw[i].shift_px.x());
      y.push_back(raw[i].shift_px.y());
      turn.push_back(raw[i].turn_rad);
      growth.push_back(raw[i].growth);
    }
    motion.shift_px = {median_of(x), median_of(y)};
    motion.turn_rad = median_of(turn);
    motion.growth = median_of(growth);
  }
  return course;
}

}  // namespace

Vector2d PictureMotion::at(const Vector2d& pixel) const {
  const Vector2d arm = pixel - about_px;
  return shift_px + growth * arm + turn_rad * Vector2d(-arm.y(), arm.x());
}

TagCorners CameraMotion::steadied(double pts_s, const TagCorners& corners) const {
  if (course.empty() || most_px < kWorthIt_px) return corners;
  const auto after = std::lower_bound(course.begin(), course.end(), pts_s,
                                      [](const PictureMotion& m, double t) { return m.pts_s < t; });
  const PictureMotion& to = after == course.end() ? course.back() : *after;
  const PictureMotion& from = after == course.begin() ? to : *(after - 1);
  const double span = to.pts_s - from.pts_s;
  const double part = span > 0 ? std::clamp((pts_s - from.pts_s) / span, 0.0, 1.0) : 1;
  TagCorners steady = corners;
  for (Vector2d& corner : steady) corner -= (1 - part) * from.at(corner) + part * to.at(corner);
  return steady;
}

CameraMotion camera_motion(const std::vector<FloorLook>& looks, const std::vector<TagCorners>& start) {
  CameraMotion found;
  Vector2d about(0, 0);
  for (std::size_t tag = 0; tag < start.size(); ++tag) {
    found.means.push_back(mean_of(looks, tag, start[tag]));
    found.seen.push_back(static_cast<std::size_t>(std::count_if(
        looks.begin(), looks.end(), [&](const FloorLook& look) { return look.tags[tag].has_value(); })));
    about += center_of(found.means.back()) / static_cast<double>(start.size());
  }
  std::vector<PictureMotion> raw;
  for (const FloorLook& look : looks)
    if (const auto motion = motion_at(look, found.means, about)) raw.push_back(*motion);
  constexpr std::size_t kLeastLooks = 5;
  if (raw.size() < kLeastLooks) return found;
  found.course = smoothed(raw);
  double squares = 0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    squares += (raw[i].shift_px - found.course[i].shift_px).squaredNorm();
    const double off = (found.course[i].shift_px - found.course.front().shift_px).norm();
    found.most_px = std::max(found.most_px, off);
  }
  for (const PictureMotion& motion : found.course) {
    found.most_at_s = motion.pts_s;
    if ((motion.shift_px - found.course.front().shift_px).norm() >= found.most_px / 2) break;
  }
  found.shake_px = std::sqrt(squares / static_cast<double>(raw.size()));
  return found;
}

}  // namespace astro::film
