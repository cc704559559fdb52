#pragma once

#include <cstdint>

#include "common/kinematics/geometry.hpp"
#include "common/params/parameter_set.hpp"

namespace astro {

/// What a gyro and the wheels say about the same 10 ms.
struct HeadingStep {
  std::int64_t gyro_48 = 0;    // how far the gyro says that the robot has turned, with its bias; 2^-48 turn
  std::int32_t wheels_32 = 0;  // how far the wheels say that it has; 2^-32 turn
  std::uint32_t path_20 = 0;   // how far both wheels have rolled together, in either direction; 2^-20 m
};

/// Heading from a gyro and the wheels: a Kalman filter with two states, the heading and the gyro's bias. The gyro predicts, the
/// wheels' increment is the measurement, whose noise grows with the distance rolled. So the gyro decides while the robot moves, and
/// a stand is a zero-velocity update, which finds the bias and wins back the heading that a wrong bias has cost.
///
///   w = gyro - bias,  r = wheels - w,  heading += w + G_h r,  bias += G_b r
///   c_h = q_g - P_hb,  c_b = -P_bb,  S = P_bb + q_g + q_w,  G = c / S,  P_hb -= P_bb first, then P -= G c
///
/// The variance of the heading is needed for neither gain, so there is none. What is kept of the heading is its difference to the
/// wheels' heading, so that it stays continuous while there is no gyro.
///
/// Not every innovation updates the states; the heading then follows the gyro alone:
///   - beyond 6 sigma. At rest, sigma is that of the gyro: with the counts' resolution in it a slow push would count as bias.
///   - in the first 0.1 s of a stand, while the body still rocks, and in a stand whose samples scatter more than the sensor's noise
///     does, because somebody handles the robot.
///   - while `believe_wheels` is false.
/// The bias begins as the mean of half a second at rest. Before that, correction_48() stays 0. If a stand without scatter disagrees
/// with the bias for five seconds more than it agrees, the bias begins anew, because it has moved (a sensor that warms up). A mean
/// beyond 10 degrees a second is no bias.
///
/// Units   increments of 10 ms; heading in 2^-48 turn, variances in (2^-32 turn)^2
/// Errors  within 0.01 degrees of the same filter in double (tests/common/kinematics). No number is wider than 63 bits.
/// Cost    constant, one 32-bit division; callable from the control tick
/// Source  angle random walk, wheel slip and bias walk as measured on the reference robot and in its gyro's data sheet
class HeadingFilter {
 public:
  static constexpr int kStep_ms = 10;

  /// What the parameters mean for the filter. It takes long divisions, so it is computed outside the tick.
  struct Configuration {
    Configuration() = default;
    [[gnu::cold]] Configuration(const ParameterSet& set, const Geometry& geometry);

    std::int64_t slip_per_m_10 = 0;  // variance of the wheels' heading per metre rolled, 2^-10
    std::int64_t rounding = 0;       // variance of a difference of two headings that are rounded to counts
  };

  void configure(const Configuration& configuration) { configuration_ = configuration; }

  void advance(const HeadingStep& step, bool believe_wheels);
  /// The gyro said nothing in this step: the heading goes on as the wheels' does.
  void skip() { at_rest_ = learned_ = disagrees_ = 0; }

  /// The bias is known. Until then, corrections are 0.
  bool knows_bias() const { return knows_bias_; }
  /// Heading minus the wheels' heading since start; wraps at 2^16 turns.
  std::int64_t correction_48() const { return static_cast<std::int64_t>(correction_); }
  /// 2^-48 turn in 10 ms.
  std::int64_t bias_48() const { return bias_; }
  /// The variance of the bias, (2^-32 turn in 10 ms)^2.
  std::int64_t bias_variance() const { return p_bb_ >> 16; }
  /// The innovation r of the last step, 2^-48 turn; 0 while the bias is not known.
  std::int64_t innovation_48() const { return innovation_; }
  /// The variance of the wheels' slip over a path of at most 8 m.
  std::int64_t slip(std::int64_t path_20) const {
    constexpr std::int64_t kMost_20 = 1 << 23;
    return (((path_20 < kMost_20 ? path_20 : kMost_20) >> 4) * configuration_.slip_per_m_10) >> 6;
  }

  /// Variance of the gyro's noise in a step: an angle random walk of 0.025 degrees per root second, as a FXAS21002C has.
  static constexpr std::int64_t kGyro = 889'599'926;

 private:
  void note_scatter(std::int64_t gyro_48);
  void learn(std::int64_t gyro_48);
  bool accepts(std::int64_t innovation_48, std::int64_t variance, bool at_rest);
  void update(std::int64_t variance);

  Configuration configuration_;
  std::uint64_t correction_ = 0;
  std::int64_t bias_ = 0, innovation_ = 0;
  std::int64_t p_hb_ = 0;  // 2^-8
  std::int64_t p_bb_ = 0;  // 2^-16
  bool knows_bias_ = false;
  int at_rest_ = 0;    // steps without a count
  int disagrees_ = 0;  // steps of a quiet stand whose innovation was refused, minus those whose was not
  int learned_ = 0;    // steps in the sums
  std::int64_t first_ = 0, sum_ = 0,
               squares_ = 0;  // of the gyro's steps, minus the first of them, in 2^-40 turn
  std::int64_t before_ = 0;   // the gyro's last step
  std::int64_t scatter_ = 0;  // mean square of the differences between steps of a stand, (2^-40 turn)^2
};

}  // namespace astro
