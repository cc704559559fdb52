#include "common/control/wheel_pair.hpp"

namespace astro {

WheelPair::Points WheelPair::points(const WheelSpeeds& wanted, const WheelSpeeds& accelerations,
                                    const WheelSpeeds& measured) const {
  const WheelSpeeds set_points = shrunk(wanted);
  const std::int32_t catch_up = mul_high(behind_nm_, k_sync_);
  const std::int32_t left = subtract_saturated(set_points.left_umps, measured.left_umps);
  const std::int32_t right = subtract_saturated(set_points.right_umps, measured.right_umps);
  return {{set_points.left_umps, accelerations.left_umps, add_saturated(left, catch_up)},
          {set_points.right_umps, accelerations.right_umps, subtract_saturated(right, catch_up)}};
}

// 1/s in 2^-16 becomes (um/s per nm) in 2^-32.
PairGains::PairGains(const ParameterSet& set)
    : left(left_gains(set)),
      right(right_gains(set)),
      k_sync(saturate32((std::int64_t{set.get(Param::k_sync)} << 16) / 1000)) {}

void WheelPair::set_gains(const PairGains& gains, const WheelSpeeds& set_points,
                          const WheelSpeeds& accelerations, const WheelSpeeds& measured) {
  const Points before = points(set_points, accelerations, measured);
  k_sync_ = gains.k_sync;
  const Points now = points(set_points, accelerations, measured);
  if (limited_) {  // the output will not bump: it is at the limit, and what is beyond is not to be kept
    left_.set_gains(gains.left);
    right_.set_gains(gains.right);
    return;
  }
  left_.set_gains(gains.left, before.left, now.left);
  right_.set_gains(gains.right, before.right, now.right);
}

void WheelPair::reset() {
  left_.reset();
  right_.reset();
  behind_nm_ = 0;
  share_16_ = kWhole;
  limited_ = false;
}

void WheelPair::note(bool limited) {
  limited_ = limited;
  share_16_ += limited ? -kShareStep : kShareStep;
  if (share_16_ > kWhole) share_16_ = kWhole;
  if (share_16_ < 0) share_16_ = 0;
}

}  // namespace astro
