#include "host/film/picture/corner_refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "host/base/order_statistics.hpp"

namespace astro::film {
namespace {

using Eigen::Vector2d;

constexpr double kShortestSide_px = 12, kFarthest_px = 3;
constexpr double kOffEnds = 0.12;    // of the edge, left out at either end: the neighbouring edge blurs it
constexpr double kReach_px = 3.5;    // across the edge to either side, at most
constexpr double kReachCells = 0.9;  // and at most this part of a cell, because the pattern begins behind it
constexpr double kStep_px = 0.25;
constexpr std::size_t kMostSteps = 2 * 14 + 1;
constexpr float kFloor = 0.15F;          // of the greatest gradient; removes noise and blur of the pattern
constexpr float kLeastContrast = 0.02F;  // of full white

/// Bilinear interpolation of light. Precondition: 0 <= x <= width - 1, and alike for y.
float light_at(const GrayFrame& frame, const std::array<float, 256>& light, double x, double y) {
  const int left = std::min(static_cast<int>(x), frame.width - 2),
            top = std::min(static_cast<int>(y), frame.height - 2);
  const float fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
  const std::uint8_t *above = frame.row(top) + left, *below = above + frame.width;
  const float first = light[above[0]] + fx * (light[above[1]] - light[above[0]]);
  const float second = light[below[0]] + fx * (light[below[1]] - light[below[0]]);
  return first + fy * (second - first);
}

struct EdgePoint {
  double along, across;  // px from the middle of the edge, and outward from it
  double width;
  float contrast;
};

/// The edge in a profile of light from black to white, by the centroid of its gradient. Nothing if the
/// contrast is too low.
std::optional<EdgePoint> crossing(const std::array<float, kMostSteps>& profile, std::size_t steps,
                                  double reach, double along) {
  float most = 0;
  for (std::size_t i = 1; i < steps; ++i) most = std::max(most, profile[i] - profile[i - 1]);
  double sum = 0, first = 0, second = 0;
  for (std::size_t i = 1; i < steps; ++i) {
    const double weight = static_cast<double>(profile[i] - profile[i - 1] - kFloor * most);
    if (!(weight > 0)) continue;
    const double at = kStep_px * (static_cast<double>(i) - 0.5) - reach;
    sum += weight;
    first += weight * at;
    second += weight * at * at;
  }
  const float contrast = profile[steps - 1] - profile[0];
  if (!(sum > 0) || contrast < kLeastContrast) return std::nullopt;
  const double mean = first / sum;
  return EdgePoint{along, mean, std::sqrt(std::max(0.0, second / sum - mean * mean)), contrast};
}

struct Line {
  double offset = 0, slope = 0;  // across = offset + slope * along
};

/// Iteratively reweighted least squares with Tukey's biweight.
std::optional<Line> robust_line(const std::vector<EdgePoint>& points) {
  std::vector<double> offsets;
  for (const EdgePoint& point : points) offsets.push_back(point.across);
  Line line{median_of(std::move(offsets)), 0};
  double scale = 1;  // px; the detector's corners may be off by that much
  for (int round = 0; round < 6; ++round) {
    double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0, wrr = 0;
    for (const EdgePoint& point : points) {
      const double r = (point.across - line.offset - line.slope * point.along) / (4.7 * scale);
      const double weight = std::abs(r) < 1 ? (1 - r * r) * (1 - r * r) : 0;
      w += weight;
      wx += weight * point.along;
      wy += weight * point.across;
      wxx += weight * point.along * point.along;
      wxy += weight * point.along * point.across;
    }
    const double spread = w * wxx - wx * wx;
    if (!(w > 0.3 * static_cast<double>(points.size())) || !(spread > 0)) return std::nullopt;
    line.slope = (w * wxy - wx * wy) / spread;
    line.offset = (wy - line.slope * wx) / w;
    for (const EdgePoint& point : points) {
      const double r = point.across - line.offset - line.slope * point.along;
      wrr += std::min(r * r, 9 * scale * scale);
    }
    scale = std::max(0.05, std::sqrt(wrr / static_cast<double>(points.size())));
  }
  return line;
}

struct FoundEdge {
  Vector2d point, direction;
  double width_px = 0;
  float contrast = 0;
};

std::optional<FoundEdge> edge_between(const GrayFrame& frame, const Vector2d& from, const Vector2d& to,
                                      double cell_px) {
  const double length = (to - from).norm();
  const Vector2d along = (to - from) / length;
  const Vector2d out{-along.y(), along.x()};  // outward, because y points down the picture
  const double reach = std::min(kReach_px, kReachCells * cell_px);
  const auto half = static_cast<std::size_t>(reach / kStep_px);
  const std::size_t steps = 2 * half + 1;
  const double ends = kStep_px * static_cast<double>(half);
  const std::array<float, 256>& light = linear_light();
  std::vector<EdgePoint> points;
  std::array<float, kMostSteps> profile{};
  const int count = static_cast<int>((1 - 2 * kOffEnds) * length);
  const Vector2d middle = (from + to) / 2;
  for (int i = 0; i <= count; ++i) {
    const double at = i - 0.5 * count;
    const Vector2d base = middle + at * along, first = base - ends * out, last = base + ends * out;
    const auto outside = [&](const Vector2d& p) {
      return !(p.x() >= 0 && p.y() >= 0 && p.x() <= frame.width - 1 && p.y() <= frame.height - 1);
    };
    if (outside(first) || outside(last)) return std::nullopt;
    for (std::size_t step = 0; step < steps; ++step) {
      const Vector2d p = first + kStep_px * static_cast<double>(step) * out;
      profile[step] = light_at(frame, light, p.x(), p.y());
    }
    if (const auto point = crossing(profile, steps, ends, at)) points.push_back(*point);
  }
  if (points.size() < 5 || 2 * static_cast<int>(points.size()) < count) return std::nullopt;
  const auto line = robust_line(points);
  if (!line) return std::nullopt;
  FoundEdge edge{middle + line->offset * out, along + line->slope * out, 0, 0};
  for (const EdgePoint& point : points) {
    edge.width_px += point.width / static_cast<double>(points.size());
    edge.contrast += point.contrast / static_cast<float>(points.size());
  }
  return edge;
}

std::optional<RefinedTag> refined_once(const GrayFrame& frame, const TagCorners& corners) {
  if (shortest_side(corners) < kShortestSide_px) return std::nullopt;
  const double cell_px = shortest_side(corners) / kTagCells;
  std::array<FoundEdge, 4> edges;
  RefinedTag tag{corners, 0, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto edge = edge_between(frame, corners[i], corners[(i + 1) % 4], cell_px);
    if (!edge) return std::nullopt;
    edges[i] = *edge;
    tag.edge_width_px += edge->width_px / 4;
    tag.contrast = std::min(tag.contrast, static_cast<double>(edge->contrast));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const FoundEdge &a = edges[(i + 3) % 4], &b = edges[i];
    const double across = a.direction.x() * b.direction.y() - a.direction.y() * b.direction.x();
    if (std::abs(across) < 0.1) return std::nullopt;
    const Vector2d gap = b.point - a.point;
    tag.corners[i] =
        a.point + a.direction * ((gap.x() * b.direction.y() - gap.y() * b.direction.x()) / across);
  }
  return tag;
}

}  // namespace

const std::array<float, 256>& linear_light() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> light{};
    for (std::size_t i = 0; i < light.size(); ++i) {
      const double value = static_cast<double>(i) / 255;
      light[i] =
          static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
    }
    return light;
  }();
  return table;
}

std::optional<RefinedTag> refine_corners(const GrayFrame& frame, const TagCorners& start) {
  std::optional<RefinedTag> tag = refined_once(frame, start);
  if (tag) tag = refined_once(frame, tag->corners);
  if (!tag) return std::nullopt;
  for (std::size_t i = 0; i < 4; ++i)
    if (!((tag->corners[i] - start[i]).norm() < kFarthest_px)) return std::nullopt;
  return tag;
}

}  // namespace astro::film
