#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "host/calibration/motion/arc.hpp"
#include "host/wall/wall_plan.hpp"

namespace astro::wall {

/// A robot with known factors that drives moves in front of a wall, without firmware and forces: its wheels slip, and it squares itself
/// with an error.
class SyntheticRobot {
 public:
  SyntheticRobot(const calibration::WheelFactors& actual, const WallNoise& noise, std::uint64_t seed)
      : actual_(actual), noise_(noise), random_(seed) {
    square();
  }

  /// As `believed` says the robot drives straight and whole turns, and its last approach turns it flush.
  void drive(const WallMove& move, const calibration::WheelFactors& believed) {
    roll(-move.away_m, -move.away_m, believed);
    if (move.kind == WallMove::Kind::gap) read(believed);
    const double rim_m = std::numbers::pi * believed.b_m * move.turns;
    roll(rim_m, -rim_m, believed);
    const double forward_m = 2 * std::abs(move.turns) * move.line_m;
    roll(forward_m, forward_m, believed);
    roll(move.away_m, move.away_m, believed);
    square();
  }

  WallDrive drive_so_far() const { return {series_}; }
  WallSeries& series() { return series_; }

 private:
  double off(double deviation) { return deviation * normal_(random_); }

  void roll(double right_m, double left_m, const calibration::WheelFactors& believed) {
    roll_nominal(right_m / believed.c_r, left_m / believed.c_l);
  }
  void roll_nominal(double right_m, double left_m) {
    travel_.right_m += right_m;
    travel_.left_m += left_m;
    travel_.right_path_m += std::abs(right_m);
    travel_.left_path_m += std::abs(left_m);
    const double right_slip_m = off(std::sqrt(noise_.K_m * std::abs(right_m)));
    const double left_slip_m = off(std::sqrt(noise_.K_m * std::abs(left_m)));
    heading_rad_ += (actual_.c_r * right_m + right_slip_m - actual_.c_l * left_m - left_slip_m) / actual_.b_m;
    slip_m_ += (right_slip_m + left_slip_m) / 2;
  }
  void read(const calibration::WheelFactors&) {
    const double driven_m = backed_off_m(travel_ - series_.squarings.back(), actual_);
    series_.readings.push_back(
        {travel_, driven_m - slip_m_ + off(noise_.reading_m) - contact_m_, series_.squarings.size() - 1});
  }
  /// Turns until the heading is a whole number of turns, but for an error.
  void square() {
    const double whole = 2 * std::numbers::pi * std::round(heading_rad_ / (2 * std::numbers::pi));
    const double turn_m = (whole + off(noise_.squaring_rad) - heading_rad_) * actual_.b_m / 2;
    const double K_m = std::exchange(noise_.K_m, 0);
    roll_nominal(turn_m / actual_.c_r, -turn_m / actual_.c_l);
    noise_.K_m = K_m;
    slip_m_ = 0;
    series_.squarings.push_back(travel_);
  }

  calibration::WheelFactors actual_;
  WallNoise noise_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  WheelTravel travel_;
  WallSeries series_;
  double heading_rad_ = 0, slip_m_ = 0, contact_m_ = off(noise_.contact_m);
};

inline constexpr WallNoise kNoNoise{0, 0, 0, 0};
inline constexpr calibration::WheelFactors kNominal{1, 1, 0.29};

/// The factors for these ratios and this scale.
inline calibration::WheelFactors factors_with(double E_d, double b_per_scale_m, double scale) {
  return {2 * scale * E_d / (1 + E_d), 2 * scale / (1 + E_d), scale * b_per_scale_m};
}

}  // namespace astro::wall
