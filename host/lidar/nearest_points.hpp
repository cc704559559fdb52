#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/lidar/surface.hpp"

namespace astro::lidar {

/// The points of a surface, arranged so that the nearest one is found fast: a tree that halves them by x and by y in turns (Bentley
/// 1975). Cost  n log^2 n to arrange, log n on average for a search.
class NearestPoints {
 public:
  explicit NearestPoints(std::vector<SurfacePoint> points);

  const std::vector<SurfacePoint>& points() const { return points_; }
  /// The point that is nearest to `to`, if one is nearer than `within_m`; otherwise null.
  const SurfacePoint* nearest(const Point2& to, double within_m) const;

 private:
  struct Search {
    Point2 to;
    double squared;  // of the nearest distance so far
    const SurfacePoint* found;
  };
  void arrange(std::size_t first, std::size_t last, bool by_x);
  void search(std::size_t first, std::size_t last, bool by_x, Search& search) const;

  std::vector<SurfacePoint> points_;  // of each range, the middle one splits the others
};

}  // namespace astro::lidar
