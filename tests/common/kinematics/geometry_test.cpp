#include "common/kinematics/geometry.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include "tests/common/kinematics/near.hpp"

namespace astro {
namespace {

using boost::multiprecision::cpp_int;
using tests::ExactGeometry;
using tests::Real;

// Half a unit of rounding; the rest is pi as a fraction (6e-19) and long double (1e-19 a few times) of at
// most 2^52.
constexpr Real kOneRounding = 0.51L;

Real unit(Real value, int bits) { return std::ldexp(value, bits); }

/// c D den / (2 n num b) turns: rational, so it has one right answer.
std::int64_t exact_turn(const ParameterSet& set, Param correction) {
  const cpp_int above =
      (cpp_int(set.get(correction)) * set.get(Param::wheel_diameter) * set.get(Param::gear_denominator))
      << (64 - 30);
  const cpp_int below =
      cpp_int(2) * set.get(Param::counts_per_motor_rev) * set.get(Param::gear_numerator) * set.get(Param::b);
  return static_cast<std::int64_t>((2 * above + below) / (2 * below));
}

void expect_exact(const ParameterSet& set) {
  const Geometry got = make_geometry(set);
  const ExactGeometry real(set);
  EXPECT_PRED_FORMAT3(tests::near, got.left.half_travel, unit(real.left_m / 2, 61), kOneRounding);
  EXPECT_PRED_FORMAT3(tests::near, got.right.half_travel, unit(real.right_m / 2, 61), kOneRounding);
  EXPECT_EQ(got.left.turn, exact_turn(set, Param::c_L));
  EXPECT_EQ(got.right.turn, exact_turn(set, Param::c_R));
  EXPECT_PRED_FORMAT3(tests::near, got.left.speed, unit(real.left_m * 1e9L, 12),
                      kOneRounding);  // m per tick of 1 ms -> 1e-6 m/s
  EXPECT_PRED_FORMAT3(tests::near, got.right.speed, unit(real.right_m * 1e9L, 12), kOneRounding);
  EXPECT_PRED_FORMAT3(tests::near, got.half_base_30, unit(real.base_m / 2, 30), kOneRounding);
  EXPECT_PRED_FORMAT3(tests::near, got.inverse_base_25, unit(1 / real.base_m, 25), kOneRounding);
}

TEST(Geometry, OfTheReferenceRobotIsExactToOneRounding) {
  expect_exact(ParameterSet::defaults());
  expect_exact(tests::calibrated_astro());
}

TEST(Geometry, OfEveryValidRobotIsExactToOneRounding) {
  tests::Seeded random(1);
  for (int i = 0; i < 20'000 && !HasFailure(); ++i) expect_exact(tests::random_robot(random));
}

TEST(Geometry, LeavesRoomForTheCountsOfATick) {
  tests::Seeded random(2);
  for (int i = 0; i < 20'000; ++i) {
    const Geometry got = make_geometry(tests::random_robot(random));
    // The robot refuses counts of more than a sixteenth of a turn. So many of both wheels stay below 2^63,
    // which is 4 m.
    constexpr std::int64_t kSixteenthTurn = std::int64_t{1} << 60, kTwoMetres = std::int64_t{1} << 62;
    for (const Geometry::Wheel& wheel : {got.left, got.right}) {
      ASSERT_GT(wheel.turn, 0);
      ASSERT_GT(wheel.half_travel, 0);
      ASSERT_LT(wheel.half_travel, kTwoMetres / (kSixteenthTurn / wheel.turn + 1));
    }
  }
}

TEST(Geometry, OfTheReferenceRobotHasTheValuesOfItsDataSheet) {
  // 64 * 43.8 = 2803.2 counts per wheel turn of pi * 72 mm: 80.6916 um per count.
  const Geometry got = make_geometry(ParameterSet::defaults());
  EXPECT_PRED_FORMAT3(tests::near, std::ldexp(static_cast<Real>(got.left.half_travel), -60), 80.6916e-6L,
                      0.0001e-6L);
  EXPECT_PRED_FORMAT3(tests::near, std::ldexp(static_cast<Real>(got.left.turn), -64),
                      0.072L / (2 * 2803.2L * 0.29L), 1e-15L);
  EXPECT_EQ(got.left.turn, got.right.turn);
}

}  // namespace
}  // namespace astro
