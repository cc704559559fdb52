#include "host/calibration/preparation/relative_pose.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "host/base/order_statistics.hpp"
#include "host/calibration/motion/arc.hpp"
#include "host/calibration/preparation/path_alignment.hpp"

namespace astro::calibration {
namespace {

constexpr double kLeastPiece_m = 0.3, kLeastPiece_rad = 0.5;
// Limits the turn by the wheels in a piece, because a gap of the tracker may hide more than half a turn,
// which headings do not show.
constexpr double kSurely_rad = 2.5;

// The displacements as 0 = row * (b, x, y, cos yaw, sin yaw), with two rows for each piece.
Eigen::Matrix<double, 5, 5> displacement_normal(std::span<const RelativePose> pieces,
                                                const TurnRates& rates) {
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  for (const RelativePose& piece : pieces) {
    const Pose2 robot = displacement(piece, rates), &sensor = piece.moved;
    const double c = std::cos(robot.theta_rad), s = std::sin(robot.theta_rad);
    Eigen::Matrix<double, 2, 5> rows;
    rows << -robot.x_m, 1 - c, s, sensor.x_m, -sensor.y_m,  //
        -robot.y_m, -s, 1 - c, sensor.y_m, sensor.x_m;
    normal += rows.transpose() * rows;
  }
  return normal;
}

/// The largest sum of a column's magnitudes.
double norm(const Eigen::Matrix3d& matrix) { return matrix.cwiseAbs().colwise().sum().maxCoeff(); }

/// The eigenvector of a symmetric matrix for its smaller eigenvalue.
Eigen::Vector2d least_eigenvector(const Eigen::Matrix2d& a) {
  const double largest_rad = std::atan2(a(0, 1) + a(1, 0), a(0, 0) - a(1, 1)) / 2;
  return {-std::sin(largest_rad), std::cos(largest_rad)};
}

double quantile(const std::vector<double>& values, double fraction) {
  const auto index =
      static_cast<std::size_t>(std::floor(fraction * static_cast<double>(values.size()) + 0.5));
  return at_rank(values, std::min(index, values.size() - 1));
}

/// What the sensor should have measured on a robot with these values.
Pose2 expected_motion(const RelativePose& piece, const RelativePoseFit& fit) {
  const Pose2 robot = displacement(piece, {-fit.r_left / fit.b_m, fit.r_right / fit.b_m});
  return fit.sensor.between(Pose2{fit.b_m * robot.x_m, fit.b_m * robot.y_m, robot.theta_rad} * fit.sensor);
}

std::vector<RelativePose> without_worst(std::vector<RelativePose> pieces, const RelativePoseFit& fit,
                                        double fraction) {
  std::vector<double> position, heading;
  for (const RelativePose& piece : pieces) {
    const Pose2 error = difference(expected_motion(piece, fit), piece.moved);
    position.push_back(std::hypot(error.x_m, error.y_m));
    heading.push_back(std::abs(error.theta_rad));
  }
  const double most_position = quantile(position, 1 - fraction),
               most_heading = quantile(heading, 1 - fraction);
  std::vector<RelativePose> kept;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (position[i] <= most_position && heading[i] <= most_heading) kept.push_back(std::move(pieces[i]));
  return kept;
}

}  // namespace

std::vector<RelativePose> pieces_of(const PreparedRun& run, const ClockFit& clock, double wheelbase_m) {
  std::vector<RelativePose> pieces;
  if (run.truth.empty()) return pieces;
  const auto robot_s = [&](std::size_t i) {
    return clock.robot_time_s(run.truth[i].time_s, run.clock_middle_s);
  };
  WheelWalk walk(run.source->wheels, robot_s(0));
  std::vector<WheelStep> steps;
  std::size_t from = 0;
  double travelled_m = 0, turned_rad = 0;
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    walk.go(robot_s(i), [&](const WheelStep& step) {
      steps.push_back(step);
      travelled_m += (step.left + step.right) / 2;
      turned_rad += (step.right - step.left) / wheelbase_m;
    });
    if (std::abs(travelled_m) < kLeastPiece_m && std::abs(turned_rad) < kLeastPiece_rad) continue;
    if (std::abs(turned_rad) < kSurely_rad)
      pieces.push_back({std::move(steps), wrapped(pose_of(run.truth[from]).between(pose_of(run.truth[i])))});
    steps.clear();
    from = i;
    travelled_m = turned_rad = 0;
  }
  return pieces;
}

Pose2 displacement(const RelativePose& piece, const TurnRates& rates) {
  Pose2 at;
  for (const WheelStep& step : piece.steps)
    advance(at, rates.right * step.right, -rates.left * step.left, 1.0);
  return at;
}

std::optional<TurnRates> fit_headings(std::span<const RelativePose> pieces) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right_side = Eigen::Vector2d::Zero();
  for (const RelativePose& piece : pieces) {
    Eigen::Vector2d travel = Eigen::Vector2d::Zero();
    for (const WheelStep& step : piece.steps) travel += Eigen::Vector2d(step.left, step.right);
    normal += travel * travel.transpose();
    right_side += travel * piece.moved.theta_rad;
  }
  // Straight pieces alone do not determine the sum of both, spins alone not the difference.
  if (!(normal.determinant() > 1e-9 * normal.trace() * normal.trace())) return {};
  const Eigen::Vector2d rates = normal.inverse() * right_side;
  return TurnRates{rates[0], rates[1]};
}

std::optional<RelativePoseFit> fit_relative_poses(std::span<const RelativePose> pieces) {
  if (pieces.size() < 3) return {};
  const std::optional<TurnRates> rates = fit_headings(pieces);
  if (!rates) return {};
  const Eigen::Matrix<double, 5, 5> normal = displacement_normal(pieces, *rates);
  const Eigen::Matrix3d free = normal.topLeftCorner<3, 3>();
  const Eigen::Matrix3d inverse = free.inverse();
  // An inverse by cofactors loses as many digits as the condition number has. Half of them are left at this one.
  constexpr double kWorstCondition = 1e8;
  const double condition = norm(free) * norm(inverse);
  if (!(condition < kWorstCondition)) return {};
  const Eigen::Matrix<double, 3, 2> mixed = normal.topRightCorner<3, 2>();
  const Eigen::Matrix<double, 3, 2> solved = inverse * mixed;
  const Eigen::Matrix2d reduced = normal.bottomRightCorner<2, 2>() - mixed.transpose() * solved;
  Eigen::Vector2d yaw = least_eigenvector(reduced);
  Eigen::Vector3d rest = -solved * yaw;
  if (rest[0] < 0) {
    rest = -rest;
    yaw = -yaw;
  }
  return RelativePoseFit{-rates->left * rest[0],
                         rates->right * rest[0],
                         rest[0],
                         {rest[1], rest[2], std::atan2(yaw[1], yaw[0])},
                         condition};
}

std::optional<RelativePoseFit> fit_relative_poses_trimmed(std::span<const RelativePose> pieces, int rounds,
                                                          double fraction) {
  std::vector<RelativePose> kept(pieces.begin(), pieces.end());
  std::optional<RelativePoseFit> fit = fit_relative_poses(kept);
  for (int round = 0; round < rounds && fit; ++round) {
    kept = without_worst(std::move(kept), *fit, fraction);
    fit = fit_relative_poses(kept);
  }
  return fit;
}

RelativePose predicted(const RelativePose& piece, const RelativePoseFit& fit) {
  return {piece.steps, expected_motion(piece, fit)};
}

}  // namespace astro::calibration
