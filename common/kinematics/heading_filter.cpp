#include "common/kinematics/heading_filter.hpp"

#include <algorithm>
#include <bit>

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr double kSlip_m = 2.645e-6;  // variance of a wheel's travel per metre, of the reference robot
constexpr double kTwoPi = 6.283185307179586;
constexpr auto kSlip_10 = static_cast<std::int64_t>(kSlip_m * (0x1p32 / kTwoPi) * (0x1p32 / kTwoPi) / 1024);
// Of a bias that walks by 0.001 degrees a second in a root second, in one step; 2^-16.
constexpr std::int64_t kWalk_16 = 9'328'131;
// What the wheels are trusted to at rest: 3 urad. It keeps the variance S from vanishing.
constexpr std::int64_t kLeastSlip = 4'672'615;
constexpr std::int64_t kMostSlip = std::int64_t{1} << 45;
constexpr std::int64_t kMostCovariance = std::int64_t{1} << 45;
constexpr std::int64_t kMostBiasVariance_16 = std::int64_t{1} << 42;

constexpr int kSettle_steps = 10, kLearn_steps = 50, kDisagree_steps = 500;
// The samples of a stand may have twice the deviation of the sensor's noise.
constexpr std::int64_t kMostScatter_16 = 4 * HeadingFilter::kGyro << 16;
constexpr std::int64_t kGate = 36;  // 6 sigma, squared
// 10 degrees a second in a step. No sensor is so far off, so a steady rate beyond is somebody who turns the robot.
constexpr std::int64_t kMostBias = (std::int64_t{1} << 48) / 3600;

/// The reciprocal of a positive number for several quotients: at most 2^-15 of them too small. One 32-bit division.
class Reciprocal {
 public:
  explicit Reciprocal(std::int64_t of) {
    const int bits = 64 - std::countl_zero(static_cast<std::uint64_t>(of));
    shift_ = bits > 16 ? bits - 16 : 0;
    // Rounded up, so that no quotient is too large.
    inverse_32_ = UINT32_MAX / (static_cast<std::uint32_t>(of >> shift_) + 1);
  }
  /// value / number in 2^-Bits, for a number of 16 bits or more. |value| <= 2^45.
  template <int Bits>
  std::int64_t times(std::int64_t value) const {
    return (value * inverse_32_) >> (32 - Bits + shift_);
  }

 private:
  int shift_;
  std::int64_t inverse_32_;
};

}  // namespace

HeadingFilter::Configuration::Configuration(const ParameterSet& set, const Geometry& geometry) {
  constexpr std::int64_t kMicro = 1'000'000;
  const std::int64_t base_um = set.get(Param::b) / 1000;
  slip_per_m_10 = kSlip_10 * kMicro / base_um * kMicro / base_um;
  const std::int64_t turn_32 = std::max(geometry.left.turn, geometry.right.turn) >> 32;
  rounding = turn_32 * turn_32 / 3;
}

void HeadingFilter::advance(const HeadingStep& step, bool believe_wheels) {
  const bool at_rest = step.path_20 == 0;
  at_rest_ = at_rest ? std::min(at_rest_ + 1, kSettle_steps + 1) : 0;
  note_scatter(step.gyro_48);
  if (!knows_bias_) return learn(step.gyro_48);

  const std::int64_t turn_48 = step.gyro_48 - bias_;
  innovation_ = (std::int64_t{step.wheels_32} << 16) - turn_48;
  correction_ -= static_cast<std::uint64_t>(innovation_);
  p_hb_ = std::max(p_hb_ - (p_bb_ >> 8), -kMostCovariance * 256);
  // Twice the reference robot's slip: too much of it costs less than too little.
  const std::int64_t slip_now = std::clamp(2 * slip(step.path_20), kLeastSlip, kMostSlip);
  const std::int64_t variance = (p_bb_ >> 16) + kGyro + slip_now;
  // Asked in any case: a bias that jumps looks like a slip without end, and only the stand shows that it is none.
  const bool agrees = accepts(innovation_, variance, at_rest);
  if (believe_wheels && agrees) update(variance);
  p_bb_ = std::min(p_bb_ + kWalk_16, kMostBiasVariance_16);
}

void HeadingFilter::note_scatter(std::int64_t gyro_48) {
  constexpr std::int64_t kMost_40 = std::int64_t{1} << 28;
  const std::int64_t change_40 = clamp_abs((gyro_48 - before_) >> 8, kMost_40);
  before_ = gyro_48;
  scatter_ = at_rest_ > 1 ? scatter_ + (change_40 * change_40 - scatter_) / 16 : 0;
}

void HeadingFilter::learn(std::int64_t gyro_48) {
  constexpr std::int64_t kMost_40 = std::int64_t{1} << 28;
  if (at_rest_ <= kSettle_steps) {
    learned_ = 0;
    return;
  }
  if (learned_ == 0) {
    first_ = gyro_48;
    sum_ = squares_ = 0;
  }
  const std::int64_t from_first_40 = clamp_abs((gyro_48 - first_) >> 8, kMost_40);
  sum_ += from_first_40;
  squares_ += from_first_40 * from_first_40;
  if (++learned_ < kLearn_steps) return;
  learned_ = 0;
  const std::int64_t mean_40 = sum_ / kLearn_steps;
  if (squares_ / kLearn_steps - mean_40 * mean_40 > kMostScatter_16) return;
  const std::int64_t mean = first_ + mean_40 * 256;
  if (magnitude(mean) > kMostBias) return;
  bias_ = mean;
  p_hb_ = 0;
  p_bb_ = (kGyro << 16) / kLearn_steps;
  knows_bias_ = true;
  disagrees_ = 0;
}

bool HeadingFilter::accepts(std::int64_t innovation_48, std::int64_t variance, bool at_rest) {
  const std::int64_t size_32 =
      std::min(magnitude(innovation_48) >> 16, std::int64_t{1} << 31);  // a square of 62 bits
  if (!at_rest) {
    disagrees_ = 0;
    return size_32 * size_32 <= kGate * (variance + 2 * configuration_.rounding);
  }
  const bool quiet = at_rest_ > kSettle_steps && scatter_ <= 2 * kMostScatter_16;
  const bool agrees = size_32 * size_32 <= kGate * variance;
  if (!quiet) {
    disagrees_ = 0;
    return false;
  }
  if (agrees) {
    // Not from zero again: noise brings an innovation that is a little beyond the gate back into it now and then.
    disagrees_ = std::max(disagrees_ - 1, 0);
    return true;
  }
  if (++disagrees_ >= kDisagree_steps) {
    knows_bias_ = false;
    innovation_ = 0;
  }
  return false;
}

void HeadingFilter::update(std::int64_t variance) {
  constexpr std::int64_t kMostGain_16 = 1 << 26;
  constexpr std::int64_t kMostInnovation_40 = std::int64_t{1} << 34;
  const std::int64_t c_h = clamp_abs(kGyro - (p_hb_ >> 8), kMostCovariance);
  const Reciprocal inverse(variance);
  const std::int64_t gain_h_16 = clamp_abs(inverse.times<16>(c_h), kMostGain_16);
  const std::int64_t gain_b_28 = inverse.times<12>(p_bb_);  // p_bb_ has 16 more
  const std::int64_t r_40 = clamp_abs(innovation_ >> 8, kMostInnovation_40);
  correction_ += static_cast<std::uint64_t>((r_40 * gain_h_16) >> 8);
  bias_ -= (r_40 * gain_b_28) >> 20;
  p_hb_ += (gain_h_16 * (p_bb_ >> 8)) >> 16;
  p_bb_ -= (gain_b_28 * (p_bb_ >> 4)) >> 24;
}

}  // namespace astro
