#include "host/live/driver/odometry_geometry.hpp"

#include <cmath>
#include <numbers>

#include "host/base/error.hpp"
#include "host/calibration/motion/trajectory.hpp"

namespace astro::live {

OdometryGeometry OdometryGeometry::of(const std::map<std::string, double>& parameters) {
  const auto number = [&](const char* name) {
    const auto found = parameters.find(name);
    if (found == parameters.end())
      throw Error("the robot has no parameter '" + std::string(name) + "'; update both");
    return found->second;
  };
  const double counts_per_turn =
      number("counts_per_motor_rev") * number("gear_numerator") / number("gear_denominator");
  constexpr double kCalibrated = 1e-3;
  calibration::GyroErrors gyro;
  if (const auto scale = parameters.find("gyro_scale"); scale != parameters.end() && scale->second != 1)
    gyro.scale = kCalibrated;
  std::array<double, 3> settings{};
  for (std::size_t i = 0; const char* name : {"gyro_axis", "gyro_scale", "gyro_lag"}) {
    if (const auto at = parameters.find(name); at != parameters.end()) settings[i] = at->second;
    ++i;
  }
  return {{number("c_R"), number("c_L"), number("b"), number("e"), number("kappa0")},
          std::numbers::pi * number("wheel_diameter") / counts_per_turn,
          number("observer_bandwidth"),
          number("speed_limit"),
          number("yaw_rate_limit"),
          gyro,
          settings};
}

bool same(const calibration::WheelFactors& a, const calibration::WheelFactors& b) {
  constexpr double kRounding = 1e-8;  // b is held in nanometres
  return std::abs(a.c_r - b.c_r) < kRounding && std::abs(a.c_l - b.c_l) < kRounding &&
         std::abs(a.b_m - b.b_m) < kRounding && std::abs(a.e - b.e) < kRounding;
}

calibration::OdometryErrors uncalibrated_errors(double wheelbase_m) {
  constexpr double kWheel = 5e-3, kWheelbase = 1e-2, kCurvature = 2e-2;
  calibration::OdometryErrors errors{calibration::NoiseModel().K_m, calibration::FactorCovariance::Zero()};
  errors.factors(0, 0) = errors.factors(1, 1) = kWheel * kWheel;
  errors.factors(2, 2) = kWheelbase * kWheelbase * wheelbase_m * wheelbase_m;
  errors.factors(3, 3) = kCurvature * kCurvature;
  return errors;
}

}  // namespace astro::live
