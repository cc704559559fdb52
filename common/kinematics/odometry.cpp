#include "common/kinematics/odometry.hpp"

#include "common/fixed/multiply.hpp"

namespace astro {

void Odometry::advance(std::int32_t left_counts, std::int32_t right_counts) {
  integrator_.advance(
      mul_low(geometry_.left.half_travel, left_counts) + mul_low(geometry_.right.half_travel, right_counts),
      mul_low(geometry_.right.turn, right_counts) - mul_low(geometry_.left.turn, left_counts));
}

}  // namespace astro
