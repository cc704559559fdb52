#include "host/film/camera/scale_error.hpp"

#include <cmath>

namespace astro::film {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> places(const Scene& scene, const std::vector<Vector2d>& pixels) {
  std::vector<Vector2d> all;
  Vector2d mean(0, 0);
  for (const Vector2d& pixel : pixels) {
    all.push_back(on_plane(scene.camera, pixel, scene.robot_height_m).value_or(Vector2d(0, 0)));
    mean += all.back() / static_cast<double>(pixels.size());
  }
  for (Vector2d& place : all) place -= mean;
  return all;
}

/// The scale factor of the similarity that takes `from` to `to`.
double factor(const std::vector<Vector2d>& from, const std::vector<Vector2d>& to) {
  double along = 0, across = 0, squares = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    along += from[i].dot(to[i]);
    across += from[i].x() * to[i].y() - from[i].y() * to[i].x();
    squares += from[i].squaredNorm();
  }
  return squares > 0 ? std::hypot(along, across) / squares : 1;
}

}  // namespace

double scale_error(const Scene& scene, const Figures& figures, const Eigen::MatrixXd& covariance,
                   const std::vector<Vector2d>& pixels) {
  const std::vector<Vector2d> here = places(scene, pixels);
  return measured_by(scene, parameters_of(scene, figures), covariance,
                     [&](const Scene& other) { return factor(here, places(other, pixels)); })
      .sigma;
}

}  // namespace astro::film
