#include "host/truth/film/camera/edge_shift.hpp"

namespace astro::film {

TagCorners with_edges_shifted(const TagCorners& corners, double shift_px) {
  TagCorners shifted = corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d before = (corners[i] - corners[(i + 3) % 4]).normalized();
    const Eigen::Vector2d after = (corners[(i + 1) % 4] - corners[i]).normalized();
    // The shift n has a component of 1 along the inward normals (y, -x) of both edges.
    const double across = before.x() * after.y() - before.y() * after.x();
    if (across == 0) continue;
    shifted[i] += (after - before) * (shift_px / -across);
  }
  return shifted;
}

}  // namespace astro::film
