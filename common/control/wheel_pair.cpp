#include "common/control/wheel_pair.hpp"

namespace astro {

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
  if (limited_) {  // the output is at the limit and will not jump, and the excess must not go to the integral
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
