#include "host/calibration/preparation/mounting.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace astro::calibration {
namespace {

// This information, that of a prior of 1 m in units of the residuals, keeps the variance of what a drive does not show finite.
constexpr double kWideInformation = 1e-5;
constexpr double kLeastWay_m = 0.1;  // root of the sum of the squared displacements
// Residuals of pieces are a few millimetres. With hardly more pieces than unknowns they may come out smaller by chance.
constexpr double kLeastResidual_m = 5e-4;

using Row = Eigen::Matrix<double, 1, 4>;

/// The covariance of the solution. The body's displacements among the coefficients are as noisy as the residuals. This noise looks
/// like information, and it draws the solution towards zero. A circle leaves two of the four unknowns open, so that there all
/// information is noise. Hence the noise is taken off the information, and the bias counts as an error.
Eigen::Matrix4d covariance_of(const Eigen::Vector4d& solution, const Eigen::Matrix4d& normal, double rows,
                              double variance_m2) {
  const Eigen::Vector2d displacement_factors = solution.tail<2>();
  // The residuals show the displacements' noise times the length of the two factors.
  const double noise_m2 = rows * variance_m2 / displacement_factors.squaredNorm();
  Eigen::Matrix4d information = normal;
  information.diagonal().tail<2>().array() -= noise_m2;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(information);
  const Eigen::Vector4d eigenvalues = solver.eigenvalues().cwiseMax(0).array() + kWideInformation;
  const Eigen::Matrix4d inverse =
      solver.eigenvectors() * eigenvalues.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
  const Eigen::Vector4d bias = inverse.rightCols<2>() * (noise_m2 * displacement_factors);
  return variance_m2 * inverse + bias * bias.transpose();
}

}  // namespace

std::optional<Mounting> mounting_of(std::span<const RelativePose> pieces, const TurnRates& rates) {
  const double b_m = 2 / (rates.right - rates.left);
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right_side = Eigen::Vector4d::Zero();
  double squares_m2 = 0, displaced_m2 = 0;
  // b d = (1 - R) l + R(yaw) p, with the robot's displacement d in wheelbases and that of the body p.
  const auto add = [&](const Row& row, double value) {
    normal += row.transpose() * row;
    right_side += row.transpose() * value;
    squares_m2 += value * value;
  };
  for (const RelativePose& piece : pieces) {
    const Pose2 robot = displacement(piece, rates), &sensor = piece.moved;
    const double c = std::cos(robot.theta_rad), s = std::sin(robot.theta_rad);
    add({1 - c, s, sensor.x_m, -sensor.y_m}, b_m * robot.x_m);
    add({-s, 1 - c, sensor.y_m, sensor.x_m}, b_m * robot.y_m);
    displaced_m2 += b_m * b_m * (robot.x_m * robot.x_m + robot.y_m * robot.y_m);
  }
  const double rows = 2 * static_cast<double>(pieces.size());
  // A robot that only spun shows the length of the lever arm, but not its direction.
  if (rows < 6 || displaced_m2 < kLeastWay_m * kLeastWay_m) return {};
  const Eigen::LDLT<Eigen::Matrix4d> ldlt(normal + kWideInformation * Eigen::Matrix4d::Identity());
  const Eigen::Vector4d found = ldlt.solve(right_side);
  const double residual_m2 =
      std::max((squares_m2 - found.dot(right_side)) / (rows - 4), kLeastResidual_m * kLeastResidual_m);
  const double length = std::hypot(found[2], found[3]);
  if (!(length > 0.5 && length < 2)) return {};
  Mounting out;
  out.lever = {found[0], found[1], std::atan2(found[3], found[2])};
  Eigen::Matrix<double, 3, 4> by = Eigen::Matrix<double, 3, 4>::Zero();
  by(0, 0) = by(1, 1) = 1;
  by(2, 2) = -found[3] / (length * length);
  by(2, 3) = found[2] / (length * length);
  out.covariance = by * covariance_of(found, normal, rows, residual_m2) * by.transpose();
  return out;
}

}  // namespace astro::calibration
