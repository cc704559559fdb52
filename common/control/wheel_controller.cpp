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
  const std::int32_t error = saturate32(std::int64_t{set_point_umps} - measured_umps);
  const std::int64_t open_loop = kS_per_fade_.scale(clamp_abs(set_point_umps, kFadeIn_umps)) +
                                 kV_.scale(set_point_umps) + kA_.scale(acceleration_umps2) + kp_.scale(error);
  const std::int64_t wanted = open_loop + (integral_24_ >> 24);
  const bool winds_up = (wanted >= limit_uv && error > 0) || (wanted <= -limit_uv && error < 0);
  if (!winds_up) {
    integral_24_ += std::int64_t{error} * ki_tick_24_;
    integral_24_ = clamp_abs(integral_24_, std::int64_t{limit_uv} << 24);
  }
  return static_cast<std::int32_t>(clamp_abs<std::int64_t>(wanted, limit_uv));
}

}  // namespace astro
