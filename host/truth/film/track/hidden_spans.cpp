#include "host/truth/film/track/hidden_spans.hpp"

#include <algorithm>

namespace astro::film {
namespace {

/// Within one side of the tag: the next picture may not have all of it.
bool at_border(const RobotTagSeen& one, const FilmInfo& info) {
  const double side = longest_side(one.corners);
  const Eigen::Vector2d center = center_of(one.corners);
  return std::min({center.x(), center.y(), info.width - center.x(), info.height - center.y()}) < 1.5 * side;
}

}  // namespace

std::vector<HiddenSpan> hidden_spans(const FilmSightings& seen, const FilmInfo& info) {
  constexpr double kLong_s = 0.5;
  std::vector<HiddenSpan> all;
  HiddenSpan span{seen.first_s};
  const auto end_at = [&](double to_s) {
    span.to_s = to_s;
    if (span.to_s - span.from_s > kLong_s) all.push_back(span);
  };
  for (const RobotTagSeen& one : seen.robot) {
    const bool border = at_border(one, info);
    span.left_picture = span.left_picture || border;
    end_at(one.pts_s);
    span = {one.pts_s, 0, border};
  }
  end_at(seen.last_s);
  return all;
}

}  // namespace astro::film
