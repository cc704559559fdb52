#include "common/control/wheel_controller.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

Q16 q16(const ParameterSet& set, Param id) { return Q16::from_raw(set.get(id)); }

}  // namespace

WheelGains left_gains(const ParameterSet& set) {
  return {q16(set, Param::kp), q16(set, Param::ki), q16(set, Param::kS_left), q16(set, Param::kV_left),
          q16(set, Param::kA_left)};
}

WheelGains right_gains(const ParameterSet& set) {
  return {q16(set, Param::kp), q16(set, Param::ki), q16(set, Param::kS_right), q16(set, Param::kV_right),
          q16(set, Param::kA_right)};
}

void WheelController::set_gains(const WheelGains& gains, const WheelPoint& before, const WheelPoint& now) {
  const std::int64_t old_16 = sum(0, before);
  kp_ = gains.kp;
  kV_ = gains.kV;
  kA_ = gains.kA;
  // kS in volts becomes microvolts per step of the fade-in.
  kS_per_fade_ =
      Q16::from_raw(saturate32(std::int64_t{gains.kS.raw()} * 1'000'000 >> (kFadeInBits + kFineBits)));
  ki_tick_24_ = saturate32((std::int64_t{gains.ki.raw()} << 8) / 1000);
  integral_24_ += (old_16 - sum(0, now)) * 256;
}

std::int32_t WheelController::limit(std::int32_t sum_uv, std::int32_t error_umps, std::int32_t limit_uv) {
  const std::int64_t most_24 = std::int64_t{limit_uv} << 24;
  integral_24_ = clamp_abs(integral_24_, most_24);
  const bool leads_out = (sum_uv > 0) != (error_umps > 0);
  if (leads_out) integral_24_ = mul_add(integral_24_, error_umps, ki_tick_24_);
  return sum_uv > 0 ? limit_uv : -limit_uv;
}

}  // namespace astro
