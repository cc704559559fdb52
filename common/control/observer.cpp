#include "common/control/observer.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {
// Far beyond any encoder, and small enough that no product below overflows.
constexpr std::int64_t kMostCounts = 1024;
}  // namespace

void SpeedObserver::set_bandwidth(std::int32_t bandwidth_16) {
  const std::int64_t w_20 = (std::int64_t{bandwidth_16} << 4) / 1000;  // w T
  const std::int64_t square_20 = (w_20 * w_20) >> 20;
  proportional_20_ = static_cast<std::int32_t>(2 * w_20 - square_20);
  integral_20_ = static_cast<std::int32_t>(square_20);
}

void SpeedObserver::advance(std::int32_t counts) {
  const std::int64_t seen = clamp_abs<std::int64_t>(counts, kMostCounts) << 20;
  error_20_ = clamp_abs<std::int64_t>(error_20_ + seen - (speed_28_ >> 8), kMostCounts << 20);
  speed_28_ += (error_20_ * integral_20_) >> 12;
  error_20_ -= (error_20_ * proportional_20_) >> 20;
}

}  // namespace astro
