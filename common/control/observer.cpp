#include "common/control/observer.hpp"

#include "common/fixed/multiply.hpp"
#include "common/fixed/saturate.hpp"

namespace astro {

SpeedObserver::Gains::Gains(std::int32_t bandwidth_16) {
  const std::int64_t w_20 = (std::int64_t{bandwidth_16} << 4) / 1000;  // w T
  const std::int64_t square_20 = (w_20 * w_20) >> 20;
  proportional_20 = static_cast<std::int32_t>(2 * w_20 - square_20);
  integral_20 = static_cast<std::int32_t>(square_20);
}

void SpeedObserver::advance(std::int32_t counts, std::int32_t expected) {
  speed_40_ += std::int64_t{saturate_to<kExpectedBits>(expected)} << kSpeedBits;
  // Counts alone cannot make the speed so large, but a commanded acceleration that never happens could.
  if (exceeds(static_cast<std::int32_t>(speed_40_ >> 32), kMost_8))
    speed_40_ = std::int64_t{speed_40_ < 0 ? -kMost_8 : kMost_8} << 32;
  const std::int32_t seen = saturate_to<kCountBits>(counts) * (1 << kSpeedBits);
  error_20_ =
      saturate_to<kCountBits + kSpeedBits>(subtract_saturated(add_saturated(error_20_, seen), speed()));
  speed_40_ = mul_add(speed_40_, error_20_, gains_.integral_20);
  error_20_ -= static_cast<std::int32_t>(mul_wide(error_20_, gains_.proportional_20) >> 20);
}

}  // namespace astro
