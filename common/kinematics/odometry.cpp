#include "common/kinematics/odometry.hpp"

#include "common/fixed/multiply.hpp"
#include "common/fixed/wide.hpp"

namespace astro {

namespace {

// value + value * part / 2^32, rounded downward.
std::int64_t add_part(std::int64_t value, std::int32_t part_32) {
  const auto low = static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
  const auto high = static_cast<std::int32_t>((value >> 32) + (low < 0 ? 1 : 0));
  return mul_add(value + (mul_wide(low, part_32) >> 32), high, part_32);
}

}  // namespace

void Odometry::advance(std::int32_t left_counts, std::int32_t right_counts, const WheelSpeeds& speeds) {
  // No bit would change: what a step leaves over is less than what a step can hold.
  if ((left_counts | right_counts) == 0) return;
  if (geometry_.effective_base.varies())
    return advance_about_effective_base(left_counts, right_counts, speeds);
  integrator_.advance(travel(left_counts, right_counts), turn(left_counts, right_counts));
}

void Odometry::advance_about_effective_base(std::int32_t left_counts, std::int32_t right_counts,
                                            const WheelSpeeds& speeds) {
  const std::int32_t inverse_32 = inverse_of_effective_base_32(geometry_, speeds);
  const std::int64_t about_b = turn(left_counts, right_counts);
  integrator_.advance(travel(left_counts, right_counts), add_part(about_b, inverse_32));
}

std::int64_t Odometry::travel(std::int32_t left_counts, std::int32_t right_counts) const {
  return mul_low(geometry_.left.half_travel, left_counts) +
         mul_low(geometry_.right.half_travel, right_counts);
}

std::int64_t Odometry::turn(std::int32_t left_counts, std::int32_t right_counts) const {
  return mul_low(geometry_.right.turn, right_counts) - mul_low(geometry_.left.turn, left_counts);
}

}  // namespace astro
