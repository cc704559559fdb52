#include "host/calibration/end_poses/end_scatter.hpp"

#include <cmath>
#include <numbers>

namespace astro::calibration {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;

/// How the end moves for each radian that the robot turns too far at `place`. The end is at the origin.
Vector3d lever_of(const Vector2d& place) { return {place.y(), -place.x(), 1}; }

Matrix3d square_of(const Vector3d& lever) { return lever * lever.transpose(); }

/// The mean along a leg. Simpson's rule is exact, because the squares of levers are parabolas along it.
Matrix3d mean_square(const Vector2d& from, const Vector2d& to) {
  return (square_of(lever_of(from)) + 4 * square_of(lever_of((from + to) / 2)) + square_of(lever_of(to))) / 6;
}

}  // namespace

Matrix3d end_covariance(double side_m, Sense sense, double b_m, const EndNoise& noise) {
  const double turned_rad2_per_m = 2 * noise.slip_m / (b_m * b_m);
  const double spin_m = b_m * pi / 4;  // travel of each wheel
  Matrix3d covariance =
      Vector3d(noise.reading_m, noise.reading_m, noise.reading_rad).cwiseAbs2().asDiagonal().toDenseMatrix();
  Vector2d place(0, 0);
  for (int leg = 0; leg < 4; ++leg) {
    const double heading_rad = sign_of(sense) * leg * pi / 2;
    const Vector2d forward(std::cos(heading_rad), std::sin(heading_rad));
    const Vector2d corner = place + side_m * forward;
    covariance += turned_rad2_per_m * side_m * mean_square(place, corner);
    covariance += turned_rad2_per_m * spin_m * square_of(lever_of(corner));
    covariance.topLeftCorner<2, 2>() += noise.slip_m / 2 * side_m * forward * forward.transpose();
    place = corner;
  }
  return covariance;
}

}  // namespace astro::calibration
