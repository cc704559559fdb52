#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>

/// A printed tag of the family tag36h11 and its corners in a picture.
namespace astro::film {

/// The corners of the black square in the order of the tag's own frame (x to the right of the upright print, y to its top,
/// z out of the paper): (-,-), (+,-), (+,+), (-,+). Pixels; pixel centres are integers, y points down the picture.
using TagCorners = std::array<Eigen::Vector2d, 4>;

/// The black square is 8 cells wide; a white margin of one cell surrounds it.
inline constexpr int kTagCells = 8;

/// Corner `index` of a tag with sides of length 1, in its own frame.
inline Eigen::Vector2d unit_corner(std::size_t index) {
  return {index == 0 || index == 3 ? -0.5 : 0.5, index < 2 ? -0.5 : 0.5};
}

inline Eigen::Vector2d center_of(const TagCorners& corners) {
  // The diagonals meet in the tag's centre, whatever the perspective.
  const Eigen::Vector2d u = corners[2] - corners[0], v = corners[3] - corners[1], w = corners[1] - corners[0];
  const double across = u.x() * v.y() - u.y() * v.x();
  if (across == 0) return (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  return corners[0] + u * ((w.x() * v.y() - w.y() * v.x()) / across);
}

inline double shortest_side(const TagCorners& corners) {
  double least = (corners[0] - corners[3]).norm();
  for (std::size_t i = 0; i < 3; ++i) least = std::min(least, (corners[i + 1] - corners[i]).norm());
  return least;
}

inline double longest_side(const TagCorners& corners) {
  double most = (corners[0] - corners[3]).norm();
  for (std::size_t i = 0; i < 3; ++i) most = std::max(most, (corners[i + 1] - corners[i]).norm());
  return most;
}

}  // namespace astro::film
