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

// kS in volts becomes microvolts per step of the fade-in.
WheelTerms::WheelTerms(const WheelGains& gains)
    : kp(gains.kp),
      kS_per_fade(Q16::from_raw(saturate32(std::int64_t{gains.kS.raw()} * 1'000'000 >>
                                           (WheelController::kFadeInBits + WheelController::kFineBits)))),
      kV(gains.kV),
      kA(gains.kA),
      ki_tick_24(saturate32((std::int64_t{gains.ki.raw()} << 8) / 1000)) {}

void WheelController::set_gains(const WheelTerms& terms, const WheelPoint& before, const WheelPoint& now) {
  const std::int64_t old_16 = sum(0, before);
  terms_ = terms;
  integral_24_ += (old_16 - sum(0, now)) * 256;
}

std::int32_t WheelController::limit(std::int32_t sum_uv, std::int32_t error_umps, std::int32_t limit_uv) {
  const std::int64_t most_24 = std::int64_t{limit_uv} << 24;
  integral_24_ = clamp_abs(integral_24_, most_24);
  const bool leads_out = (sum_uv > 0) != (error_umps > 0);
  if (leads_out) integral_24_ = mul_add(integral_24_, error_umps, terms_.ki_tick_24);
  return sum_uv > 0 ? limit_uv : -limit_uv;
}

}  // namespace astro
