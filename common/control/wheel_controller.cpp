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
  // kS in volts becomes microvolts per (um/s) of the fade-in: kS * 1e6 / 1e4.
  kS_per_fade_ = Q16::from_raw(saturate32(std::int64_t{set.get(Param::kS)} * 1'000'000 / kFadeIn_umps));
  ki_tick_24_ = saturate32((std::int64_t{set.get(Param::ki)} << 8) / 1000);
}

std::int32_t WheelController::advance(std::int32_t set_point_umps, std::int32_t acceleration_umps2,
                                      std::int32_t measured_umps, std::int32_t limit_uv) {
  const std::int32_t error = subtract_saturated(set_point_umps, measured_umps);
  std::int64_t sum_16 = mul_wide(kS_per_fade_.raw(), clamp_abs(set_point_umps, kFadeIn_umps));
  sum_16 = mul_add(sum_16, kV_.raw(), set_point_umps);
  sum_16 = mul_add(sum_16, kA_.raw(), acceleration_umps2);
  sum_16 = mul_add(sum_16, kp_.raw(), error) + (integral_24_ >> 8);

  const std::int64_t limit_16 = std::int64_t{limit_uv} << 16;
  if (sum_16 >= limit_16) {
    if (error < 0) integrate(error, limit_uv);
    return limit_uv;
  }
  if (sum_16 <= -limit_16) {
    if (error > 0) integrate(error, limit_uv);
    return -limit_uv;
  }
  integrate(error, limit_uv);
  return static_cast<std::int32_t>(sum_16 >> 16);
}

void WheelController::integrate(std::int32_t error_umps, std::int32_t limit_uv) {
  integral_24_ = mul_add(integral_24_, error_umps, ki_tick_24_);
  const auto integral_uv_8 = static_cast<std::int32_t>(integral_24_ >> 32);  // in 256 uV: enough to clamp by
  if (integral_uv_8 > limit_uv >> 8) integral_24_ = std::int64_t{limit_uv} << 24;
  if (integral_uv_8 < -limit_uv >> 8) integral_24_ = -(std::int64_t{limit_uv} << 24);
}

}  // namespace astro
