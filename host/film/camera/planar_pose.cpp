#include "host/film/camera/planar_pose.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

namespace astro::film {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// From the square's plane to the picture's, with H(2, 2) = 1.
Matrix3d homography(const TagCorners& corners, double side_m) {
  Eigen::MatrixXd a(8, 8);
  Eigen::VectorXd b(8);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d p = side_m * unit_corner(i), q = corners[i];
    const auto row = static_cast<Eigen::Index>(2 * i);
    a.row(row) << p.x(), p.y(), 1, 0, 0, 0, -p.x() * q.x(), -p.y() * q.x();
    a.row(row + 1) << 0, 0, 0, p.x(), p.y(), 1, -p.x() * q.y(), -p.y() * q.y();
    b[row] = q.x();
    b[row + 1] = q.y();
  }
  const Eigen::VectorXd h = a.colPivHouseholderQr().solve(b);
  Matrix3d result;
  result << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
  return result;
}

/// The translation for which the corners fit best, and the sum of squares that remains in the picture.
std::pair<Vector3d, double> translation_for(const Matrix3d& rotation, const TagCorners& corners,
                                            double side_m) {
  Eigen::MatrixXd a(8, 3);
  Eigen::VectorXd b(8);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d flat = side_m * unit_corner(i);
    const Vector3d p = rotation * Vector3d(flat.x(), flat.y(), 0);
    const auto row = static_cast<Eigen::Index>(2 * i);
    a.row(row) << 1, 0, -corners[i].x();
    a.row(row + 1) << 0, 1, -corners[i].y();
    b[row] = corners[i].x() * p.z() - p.x();
    b[row + 1] = corners[i].y() * p.z() - p.y();
  }
  const Vector3d t = a.colPivHouseholderQr().solve(b);
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d flat = side_m * unit_corner(i);
    const Vector3d p = rotation * Vector3d(flat.x(), flat.y(), 0) + t;
    squares += (p.head<2>() / p.z() - corners[i]).squaredNorm();
  }
  return {t, squares};
}

Matrix3d completed(const Matrix2d& upper, const Vector2d& lower) {
  Matrix3d r;
  r.col(0) << upper.col(0), lower.x();
  r.col(1) << upper.col(1), lower.y();
  r.col(2) = r.col(0).cross(r.col(1));
  return r;
}

}  // namespace

std::optional<std::array<PlanarPose, 2>> planar_poses(const TagCorners& corners, double side_m) {
  const Matrix3d h = homography(corners, side_m);
  const double p = h(0, 2), q = h(1, 2);
  Matrix2d jacobian;
  jacobian << h(0, 0) - h(2, 0) * p, h(0, 1) - h(2, 1) * p, h(1, 0) - h(2, 0) * q, h(1, 1) - h(2, 1) * q;
  const Vector3d ray = Vector3d(p, q, 1).normalized();
  const Matrix3d toward =
      Eigen::Quaterniond(1 + ray.z(), -ray.y(), ray.x(), 0).normalized().toRotationMatrix();  // turns z there
  Matrix2d b;
  b << toward(0, 0) - p * toward(2, 0), toward(0, 1) - p * toward(2, 1), toward(1, 0) - q * toward(2, 0),
      toward(1, 1) - q * toward(2, 1);
  if (!(std::abs(b.determinant()) > 1e-12) || !jacobian.allFinite()) return std::nullopt;
  const Matrix2d a = b.inverse() * jacobian;
  // Its larger singular value: the sum of the squares of both is the squared norm, their product the determinant.
  const double sum = a.squaredNorm(), product = a.determinant();
  const double largest = std::sqrt((sum + std::sqrt(std::max(0.0, sum * sum - 4 * product * product))) / 2);
  if (!(largest > 0)) return std::nullopt;
  const Matrix2d upper = a / largest;
  const Matrix2d rest = Matrix2d::Identity() - upper.transpose() * upper;
  Vector2d lower(std::sqrt(std::max(0.0, rest(0, 0))), std::sqrt(std::max(0.0, rest(1, 1))));
  if (rest(0, 1) < 0) lower.y() = -lower.y();
  std::array<PlanarPose, 2> poses;
  std::array<double, 2> misfit{};
  for (std::size_t i = 0; i < 2; ++i) {
    poses[i].rotation = toward * completed(upper, i == 0 ? lower : Vector2d(-lower));
    std::tie(poses[i].translation_m, misfit[i]) = translation_for(poses[i].rotation, corners, side_m);
  }
  if (misfit[1] < misfit[0]) std::swap(poses[0], poses[1]);
  return poses;
}

}  // namespace astro::film
