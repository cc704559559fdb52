#include "common/kinematics/effective_base.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
EffectiveBase::EffectiveBase(const ParameterSet& set) {
  constexpr std::int64_t kOne = std::int64_t{1} << 30, kMicro = 1'000'000;
  const std::int64_t e_30 = set.get(Param::e), kappa0_6 = set.get(Param::kappa0);
  varies_ = e_30 != 0 ? 1 : -1;
  narrowing_33_ = saturate32(-e_30 * (std::int64_t{1} << 33) / (kOne + e_30));

  std::int64_t weight_32 = kappa0_6 * 2 * (kOne + e_30) / kMicro;
  for (; weight_32 > UINT32_MAX; weight_32 >>= 1) ++measured_shift_;
  measured_weight_ = static_cast<std::uint32_t>(weight_32);
  commanded_weight_29_ = static_cast<std::uint32_t>((kappa0_6 << 29) / kMicro * kOne / (2 * kOne + e_30));

  const std::int64_t square_30 = (e_30 * e_30) >> 30;
  const std::int64_t second_30 = (square_30 * (2 * kOne - e_30)) >> 31;
  linear_33_ = static_cast<std::int32_t>(8 * e_30 + 4 * second_30);
  quadratic_34_ = static_cast<std::int32_t>(-24 * second_30);
  cubic_35_ = static_cast<std::int32_t>(32 * second_30);
}

}  // namespace astro
