#include "host/calibration/likelihood/gyro_pose_uncertainty.hpp"

#include <cmath>

namespace astro::calibration {
namespace {

// As in the robot's filter: it learns the bias in half a second, takes no stand before 0.1 s, and trusts the wheels to 3 urad in
// 10 ms then.
constexpr double kLearn_s = 0.5, kSettle_s = 0.1, kStep_s = 0.01, kAtRest_rad = 3e-6, kGate = 6;

}  // namespace

GyroPoseUncertainty::GyroPoseUncertainty(const WheelFactors& factors, const OdometryErrors& wheels,
                                         const GyroErrors& gyro)
    : factors_(factors), wheels_(wheels), gyro_(gyro) {
  covariance_(kBias, kBias) = gyro.random_walk_rad * gyro.random_walk_rad / kLearn_s;
  covariance_(kScale, kScale) = gyro.scale * gyro.scale;
  covariance_.block<3, 3>(kRight, kRight) = wheels.factors.topLeftCorner<3, 3>();
}

void GyroPoseUncertainty::restart(double heading_rad, const Symmetric3& start) {
  heading_rad_ = heading_rad;
  covariance_.topRows<3>().setZero();
  covariance_.leftCols<3>().setZero();
  const Matrix3 full = start.full();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      covariance_(row, column) = full[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
}

void GyroPoseUncertainty::move(const Step& step, Matrix& propagation, Matrix& noise) const {
  const double travel_m = (factors_.c_r * step.right_m + factors_.c_l * step.left_m) / 2;
  const double c = std::cos(heading_rad_ + step.turn_rad / 2), s = std::sin(heading_rad_ + step.turn_rad / 2);
  // The heading's error half-way through the step.
  const Eigen::RowVectorXd half = (propagation.row(kTheta) + Matrix::Identity().row(kTheta)) / 2;
  propagation.row(kX) += -s * travel_m * half;
  propagation.row(kY) += c * travel_m * half;
  for (const auto& [factor, way_m] :
       {std::pair{kRight, step.right_m / 2}, std::pair{kLeft, step.left_m / 2}}) {
    propagation(kX, factor) += c * way_m;
    propagation(kY, factor) += s * way_m;
  }
  const double slip = wheels_.K_m * (std::abs(step.right_m) + std::abs(step.left_m)) / 4;
  noise(kX, kX) += slip * c * c;
  noise(kX, kY) += slip * c * s;
  noise(kY, kX) += slip * c * s;
  noise(kY, kY) += slip * s * s;
}

void GyroPoseUncertainty::turn_by_gyro(const Step& step, Matrix& propagation, Matrix& noise) const {
  propagation(kTheta, kBias) = step.time_s;
  propagation(kTheta, kScale) = step.turn_rad;
  noise(kTheta, kTheta) = gyro_.random_walk_rad * gyro_.random_walk_rad * step.time_s;
}

void GyroPoseUncertainty::turn_by_wheels(const Step& step, Matrix& propagation, Matrix& noise) const {
  propagation(kTheta, kRight) = step.right_m / factors_.b_m;
  propagation(kTheta, kLeft) = -step.left_m / factors_.b_m;
  propagation(kTheta, kBase) =
      -(factors_.c_r * step.right_m - factors_.c_l * step.left_m) / (factors_.b_m * factors_.b_m);
  noise(kTheta, kTheta) =
      wheels_.K_m * (std::abs(step.right_m) + std::abs(step.left_m)) / (factors_.b_m * factors_.b_m);
}

// The gyro's increment has the error d = bias T + walk, the wheels' the error m. Heading and bias are corrected by gain times (m - d).
void GyroPoseUncertainty::rest(const Step& step, Matrix& propagation, Matrix& noise) const {
  const double time_s = step.time_s, walk = gyro_.random_walk_rad * gyro_.random_walk_rad * time_s;
  const double wheels = kAtRest_rad * kAtRest_rad * time_s / kStep_s;
  const double bias = covariance_(kBias, kBias);
  const double whole = bias * time_s * time_s + walk + wheels;
  const double by_heading = (covariance_(kTheta, kBias) * time_s + bias * time_s * time_s + walk) / whole;
  const double by_bias = bias * time_s / whole;
  propagation(kTheta, kBias) = (1 - by_heading) * time_s;
  propagation(kBias, kBias) = 1 - by_bias * time_s;
  const Eigen::Vector2d of_walk(1 - by_heading, -by_bias), of_wheels(by_heading, by_bias);
  noise.block<2, 2>(kTheta, kTheta) =
      walk * of_walk * of_walk.transpose() + wheels * of_wheels * of_wheels.transpose();
}

// More than the noise and the bias can be.
bool GyroPoseUncertainty::is_pushed(const Step& step) const {
  const double walk = gyro_.random_walk_rad * gyro_.random_walk_rad * step.time_s;
  const double bias = covariance_(kBias, kBias) * step.time_s * step.time_s;
  return std::abs(step.turn_rad) > kGate * std::sqrt(walk + bias);
}

void GyroPoseUncertainty::advance(const Step& step) {
  Matrix propagation = Matrix::Identity(), noise = Matrix::Zero();
  const bool moves = step.right_m != 0 || step.left_m != 0;
  rested_s_ = moves || (step.gyro_counts && is_pushed(step)) ? 0 : rested_s_ + step.time_s;
  if (!step.gyro_counts)
    turn_by_wheels(step, propagation, noise);
  else if (rested_s_ > kSettle_s)
    rest(step, propagation, noise);
  else
    turn_by_gyro(step, propagation, noise);
  if (step.saturated) noise(kTheta, kTheta) += step.turn_rad * step.turn_rad;
  if (moves) move(step, propagation, noise);
  noise(kBias, kBias) += gyro_.bias_walk_radps * gyro_.bias_walk_radps * step.time_s;
  covariance_ = propagation * covariance_ * propagation.transpose() + noise;
  heading_rad_ += step.turn_rad;
}

Symmetric3 GyroPoseUncertainty::covariance() const {
  return {covariance_(kX, kX), covariance_(kX, kY),     covariance_(kX, kTheta),
          covariance_(kY, kY), covariance_(kY, kTheta), covariance_(kTheta, kTheta)};
}

}  // namespace astro::calibration
