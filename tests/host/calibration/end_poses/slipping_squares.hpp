#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "host/calibration/end_poses/end_scatter.hpp"
#include "host/calibration/motion/arc.hpp"
#include "tests/host/calibration/end_poses/square_runs.hpp"

/// Squares of a robot whose wheels slip, and whose ends a person measures.
namespace astro::calibration::test {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

class SlippingRobot {
 public:
  explicit SlippingRobot(unsigned seed, EndNoise noise = {}) : random_(seed), noise_(noise) {}

  /// The error of the end: the odometry with `loaded` closes exactly.
  EndPose square(Sense sense, const WheelFactors& loaded, const WheelFactors& truth,
                 double side_m = kSide_m) {
    EndPose pose;
    const double spin_m = sign_of(sense) * loaded.b_m * std::numbers::pi / 4;
    for (int leg = 0; leg < 4; ++leg) {
      drive(pose, side_m, side_m, 30, loaded, truth);
      drive(pose, spin_m, -spin_m, 8, loaded, truth);
    }
    pose.theta_rad -= sign_of(sense) * 2 * std::numbers::pi;
    return {pose.x_m + noise_.reading_m * normal_(random_), pose.y_m + noise_.reading_m * normal_(random_),
            pose.theta_rad + noise_.reading_rad * normal_(random_)};
  }

  Runs squares(int each, const WheelFactors& loaded = kNominal, const WheelFactors& truth = kThesisRobot) {
    Runs runs;
    for (int i = 0; i < each; ++i) {
      runs.cw.push_back(square(Sense::cw, loaded, truth));
      runs.ccw.push_back(square(Sense::ccw, loaded, truth));
    }
    return runs;
  }

  /// The measured end of a line that odometry takes for `length_m`.
  EndPose line(double length_m, const WheelFactors& loaded, const WheelFactors& truth) {
    EndPose pose;
    drive(pose, length_m, length_m, 30, loaded, truth);
    return {pose.x_m + noise_.reading_m * normal_(random_), pose.y_m + noise_.reading_m * normal_(random_),
            pose.theta_rad};
  }

 private:
  /// `right_m` and `left_m` by odometry, in so many cells of independent slip.
  void drive(EndPose& pose, double right_m, double left_m, int cells, const WheelFactors& loaded,
             const WheelFactors& truth) {
    for (int i = 0; i < cells; ++i) {
      // One after the other: compilers differ in the order of arguments, and so would the draws.
      const double right = slipped(right_m * truth.c_r / loaded.c_r / cells);
      const double left = slipped(left_m * truth.c_l / loaded.c_l / cells);
      advance(pose, right, left, truth.b_m);
    }
  }
  double slipped(double travel_m) {
    return travel_m + std::sqrt(noise_.slip_m * std::abs(travel_m)) * normal_(random_);
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  EndNoise noise_;
};

}  // namespace astro::calibration::test
