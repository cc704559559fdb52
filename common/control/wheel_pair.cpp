#include "common/control/wheel_pair.hpp"

namespace astro {

void WheelPair::set_gains(const ParameterSet& set) {
  left_.set_gains(left_gains(set));
  right_.set_gains(right_gains(set));
  // 1/s in 2^-16 becomes (um/s per nm) in 2^-32.
  k_sync_ = saturate32((std::int64_t{set.get(Param::k_sync)} << 16) / 1000);
}

void WheelPair::reset() {
  left_.reset();
  right_.reset();
  behind_nm_ = 0;
  share_16_ = kWhole;
}

void WheelPair::note(bool limited) {
  share_16_ += limited ? -kShareStep : kShareStep;
  if (share_16_ > kWhole) share_16_ = kWhole;
  if (share_16_ < 0) share_16_ = 0;
}

}  // namespace astro
