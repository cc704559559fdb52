#include "common/kinematics/twist.hpp"

namespace astro {

[[gnu::noinline]] std::int32_t about_effective_base(const Geometry& geometry, const WheelSpeeds& wheels,
                                                    std::int32_t omega_uradps) {
  return add_saturated(omega_uradps, mul_high(omega_uradps, inverse_of_effective_base_32(geometry, wheels)));
}

}  // namespace astro
