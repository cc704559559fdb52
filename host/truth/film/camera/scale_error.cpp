#include "host/truth/film/camera/scale_error.hpp"

#include <algorithm>
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

/// The factor of a similarity that takes `from` to `to`.
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
  const std::vector<SceneParameter> parameters = parameters_of(scene, figures);
  const std::vector<Vector2d> here = places(scene, pixels);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].only_tag >= 0) continue;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(covariance.rows());
    const auto at = static_cast<Eigen::Index>(i);
    change[at] = parameters[i].step;
    const double ahead = factor(here, places(moved(scene, change), pixels));
    const double behind = factor(here, places(moved(scene, -change), pixels));
    gradient[at] = (ahead - behind) / (2 * parameters[i].step);
  }
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

}  // namespace astro::film
