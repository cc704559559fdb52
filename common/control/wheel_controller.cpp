#include "common/control/wheel_controller.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {
constexpr std::int32_t kFadeIn_umps = 10'000;
}

void WheelController::set_gains(const ParameterSet& set) {
  kp_ = Q16::from_raw(set.get(Param::kp));
  kV_ = Q16::from_raw(set.get(Param::kV));
  kA_ = Q16::from_raw(set.get(Param::kA));
  // kS in volts becomes microvolts per step of the fade-in.
  kS_per_fade_ =
      Q16::from_raw(saturate32(std::int64_t{set.get(Param::kS)} * 1'000'000 >> (kFadeInBits + kFineBits)));
  ki_tick_24_ = saturate32((std::int64_t{set.get(Param::ki)} << 8) / 1000);
}

}  // namespace astro
