#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/end_poses/replay.hpp"
#include "host/calibration/end_poses/umbmark.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// Noise-free experiments by exact replay, and the robot of the thesis.
namespace astro::calibration::test {

inline constexpr double kSide_m = 3;
inline const WheelFactors kNominal{1, 1, 0.290};
inline constexpr double kThesis_E_d = 1.00416;
inline constexpr double kThesis_E_b = 0.99521;
/// c_R + c_L = 2, so that no scale error is added.
inline const WheelFactors kThesisRobot{2 * kThesis_E_d / (kThesis_E_d + 1), 2 / (kThesis_E_d + 1),
                                       kThesis_E_b * 0.290};

struct Runs {
  std::vector<EndPose> cw, ccw;
};

/// One run each way.
inline Runs drive(double side_m, const WheelFactors& loaded, const WheelFactors& truth) {
  return {{replay_square(side_m, Sense::cw, loaded, truth)},
          {replay_square(side_m, Sense::ccw, loaded, truth)}};
}

inline Estimate calibrate(const Runs& runs, const WheelFactors& loaded, const Options& options,
                          double side_m = kSide_m) {
  return estimate_factors(runs.cw, runs.ccw, side_m, loaded, options);
}

/// The message of the astro::Error that `call` throws; fails the test if it throws none.
template <class Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no astro::Error was thrown";
  return "";
}

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

}  // namespace astro::calibration::test
