#pragma once

#include <cmath>

#include "hal/sim/config.hpp"

/// The robot's true pose. Each step is the exact arc of constant wheel speeds:
///
///   d = (dR + dL) / 2,  a = (dR - dL) / B
///   p <- p + R(theta) (d sin(a)/a, d (1 - cos a)/a),  theta <- theta + a
///
/// B is the wheelbase b, unless there is a curvature effect e as of real tyres: then
///
///   B = b (1 + e kappa0 |d| / (kappa0 |d| + |dR - dL|))
///
/// so that a spin turns about b and a gentle arc about b (1 + e).
///
/// Units   metres; radians, counter-clockwise, not wrapped
/// Cost    no sine or cosine for steps below kSmall_rad: the heading's unit vector is rotated with each step
///         and kept at length 1. After an hour at 1 kHz it agrees with cos(theta), sin(theta) to 1e-10.
namespace astro::sim {

struct Pose {
  double x_m = 0, y_m = 0, theta_rad = 0;
};

/// A compensated sum (Kahan). Without the compensation, equal small steps onto a large total would be rounded
/// the same way every time: 1e-8 rad of heading in an hour at 1 kHz.
class Sum {
 public:
  void set(double value) {
    value_ = value;
    lost_ = 0.0;
  }
  void add(double term) {
    const double wanted = term - lost_, sum = value_ + wanted;
    lost_ = (sum - value_) - wanted;
    value_ = sum;
  }
  double value() const { return value_; }

 private:
  double value_ = 0.0, lost_ = 0.0;
};

class Chassis {
 public:
  static constexpr double kSmall_rad = 0.05;

  explicit Chassis(double wheelbase_m) : per_wheelbase_(1.0 / wheelbase_m) {}
  explicit Chassis(const Geometry& geometry)
      : per_wheelbase_(1.0 / geometry.wheelbase_m), e_(geometry.e), kappa0_(geometry.kappa0) {}

  /// Sets the pose, as if somebody had moved the robot.
  void place(const Pose& pose) {
    x_m_.set(pose.x_m);
    y_m_.set(pose.y_m);
    theta_rad_.set(pose.theta_rad);
    cos_ = std::cos(pose.theta_rad);
    sin_ = std::sin(pose.theta_rad);
  }

  /// Without slip.
  void advance(double left_m, double right_m) { advance(left_m, right_m, left_m, right_m); }

  /// `rolled_...`: what the wheels rolled, which makes the curve. What they slipped in a millisecond on a straight line is as much
  /// as a curve of a metre or two would be.
  void advance(double left_m, double right_m, double rolled_left_m, double rolled_right_m) {
    const double along_m = 0.5 * (left_m + right_m);
    double turn = (right_m - left_m) * per_wheelbase_;
    const double along = kappa0_ * 0.5 * std::abs(rolled_left_m + rolled_right_m);
    if (e_ != 0.0 && along != 0.0)
      turn /= 1.0 + e_ * along / (along + std::abs(rolled_right_m - rolled_left_m));
    if (std::abs(turn) < kSmall_rad) {
      // Taylor series: the first omitted term is below 1e-17 relative. Both side by side, because divisions are slow and two fit
      // into one instruction.
      const double square = turn * turn;
      const Two t{square, square};
      const Two series =
          1.0 - t / Two{6.0, 12.0} *
                    (1.0 - t / Two{20.0, 30.0} * (1.0 - t / Two{42.0, 56.0} * (1.0 - t / Two{72.0, 90.0})));
      step(along_m, turn, series[0], 0.5 * turn * series[1]);
    } else {
      step(along_m, turn, std::sin(turn) / turn, (1.0 - std::cos(turn)) / turn);
    }
  }

  /// Turns the robot on the spot, which no wheel notices.
  void jump(double turn_rad) {
    if (turn_rad != 0.0)
      step(0.0, turn_rad, std::sin(turn_rad) / turn_rad, (1.0 - std::cos(turn_rad)) / turn_rad);
  }

  Pose pose() const { return {x_m_.value(), y_m_.value(), theta_rad_.value()}; }
  double cosine() const { return cos_; }
  double sine() const { return sin_; }

 private:
  using Two [[gnu::vector_size(16)]] = double;

  // sinc = sin(turn) / turn, cosc = (1 - cos(turn)) / turn
  void step(double along_m, double turn, double sinc, double cosc) {
    x_m_.add(along_m * (cos_ * sinc - sin_ * cosc));
    y_m_.add(along_m * (sin_ * sinc + cos_ * cosc));
    theta_rad_.add(turn);
    const double s = turn * sinc, c = 1.0 - turn * cosc;
    const double x = cos_ * c - sin_ * s, y = sin_ * c + cos_ * s;
    const double unit = 1.5 - 0.5 * (x * x + y * y);  // one Newton step towards 1 / length
    cos_ = x * unit;
    sin_ = y * unit;
  }

  double per_wheelbase_;
  double e_ = 0.0, kappa0_ = 0.0;
  Sum x_m_, y_m_, theta_rad_;
  double cos_ = 1.0, sin_ = 0.0;
};

}  // namespace astro::sim
