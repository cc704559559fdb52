#include "host/truth/floor/floor_points.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace astro::truth {
namespace {

/// Twice the largest distance from the mean: the same in every frame.
double extent_of(std::span<const FloorPoint> points) {
  double x = 0, y = 0, most = 0;
  for (const FloorPoint& point : points) {
    x += point.x_m / static_cast<double>(points.size());
    y += point.y_m / static_cast<double>(points.size());
  }
  for (const FloorPoint& point : points) most = std::max(most, std::hypot(point.x_m - x, point.y_m - y));
  return 2 * most;
}

/// Places that are a hundredth of the extent apart; all that is between is left out.
std::vector<FloorPoint> places_of(std::span<const FloorPoint> points) {
  const double step = extent_of(points) / 100;
  std::vector<FloorPoint> out;
  bool joined = true;
  for (const FloorPoint& point : points) {
    joined = joined && point.joined;
    const auto far = [&] {
      return std::hypot(point.x_m - out.back().x_m, point.y_m - out.back().y_m) >= step;
    };
    if (!out.empty() && !(step > 0 && far())) continue;
    out.push_back(point);
    out.back().joined = joined;
    joined = true;
  }
  return out;
}

/// How closely the direction of the path keeps to one in the body's frame, 0 to 1, for positions as they are (sign 1)
/// or reflected (-1). `fold` 2 counts forward and backward as the same.
double concentration(const std::vector<FloorPoint>& places, double sign, double fold) {
  std::complex<double> sum = 0;
  double length = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const FloorPoint &a = places[i - 1], &b = places[i];
    if (!b.joined) continue;
    const double step = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    const double direction_rad = std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
    sum += std::polar(step, fold * (sign * direction_rad - (a.theta_rad + b.theta_rad) / 2));
    length += step;
  }
  return length > 0 ? std::abs(sum) / length : 0;
}

}  // namespace

Turning path_turning(std::span<const FloorPoint> points, bool both_ways) {
  const std::vector<FloorPoint> places = places_of(points);
  const double same_rad = both_ways ? std::numbers::pi : 2 * std::numbers::pi;
  Turning out;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const FloorPoint &from = places[i - 1], &to = places[i];
    const double direction_rad = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
    const double before_rad = out.empty() ? direction_rad : out.back().angle_rad;
    const double change_rad = std::remainder(direction_rad - before_rad, same_rad);
    out.push_back({(from.time_s + to.time_s) / 2, before_rad + change_rad, from.joined && to.joined});
  }
  return out;
}

Turning heading_turning(std::span<const FloorPoint> points) {
  constexpr double kApart_s = 0.2;
  Turning out;
  bool joined = true;
  for (const FloorPoint& point : points) {
    joined = joined && point.joined;
    if (!out.empty() && point.time_s - out.back().time_s < kApart_s) continue;
    out.push_back({point.time_s, point.theta_rad, joined});
    joined = true;
  }
  return out;
}

double path_length(std::span<const FloorPoint> points) {
  const std::vector<FloorPoint> places = places_of(points);
  double length = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    length += std::hypot(places[i].x_m - places[i - 1].x_m, places[i].y_m - places[i - 1].y_m);
  return length;
}

double handedness(std::span<const FloorPoint> points) {
  if (points.empty() || std::isnan(points.front().theta_rad)) return 0;
  const std::vector<FloorPoint> places = places_of(points);
  const double forward = concentration(places, 1, 1) - concentration(places, -1, 1);
  const double both_ways = concentration(places, 1, 2) - concentration(places, -1, 2);
  return std::abs(forward) > std::abs(both_ways) ? forward : both_ways;
}

}  // namespace astro::truth
