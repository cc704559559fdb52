#include "host/lidar/nearest_points.hpp"

#include <algorithm>
#include <utility>

namespace astro::lidar {
namespace {

constexpr std::size_t kLeaf = 6;  // so few points are looked at one by one

double coordinate(const Point2& point, bool x) { return x ? point.x_m : point.y_m; }

}  // namespace

NearestPoints::NearestPoints(std::vector<SurfacePoint> points) : points_(std::move(points)) {
  arrange(0, points_.size(), true);
}

void NearestPoints::arrange(std::size_t first, std::size_t last, bool by_x) {
  if (last - first <= kLeaf) return;
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last), [by_x](const SurfacePoint& a, const SurfacePoint& b) {
    return coordinate(a.at, by_x) < coordinate(b.at, by_x);
  });
  arrange(first, middle, !by_x);
  arrange(middle + 1, last, !by_x);
}

const SurfacePoint* NearestPoints::nearest(const Point2& to, double within_m) const {
  Search found{to, within_m * within_m, nullptr};
  search(0, points_.size(), true, found);
  return found.found;
}

void NearestPoints::search(std::size_t first, std::size_t last, bool by_x, Search& best) const {
  const auto look = [&](const SurfacePoint& point) {
    const double dx_m = point.at.x_m - best.to.x_m, dy_m = point.at.y_m - best.to.y_m;
    const double squared = dx_m * dx_m + dy_m * dy_m;
    if (!(squared < best.squared)) return;
    best.squared = squared;
    best.found = &point;
  };
  if (last - first <= kLeaf) {
    for (std::size_t i = first; i < last; ++i) look(points_[i]);
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  look(points_[middle]);
  const double beyond_m = coordinate(best.to, by_x) - coordinate(points_[middle].at, by_x);
  const auto side = [&](bool upper) {
    upper ? search(middle + 1, last, !by_x, best) : search(first, middle, !by_x, best);
  };
  side(beyond_m > 0);
  if (beyond_m * beyond_m < best.squared) side(!(beyond_m > 0));
}

}  // namespace astro::lidar
