#include "common/kinematics/effective_base.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/common/kinematics/near.hpp"

namespace astro {
namespace {

using tests::ExactEffect;
using tests::Real;

constexpr Real kRounding = 0x1p-31L;  // of what both functions return in 2^-32
// As the header states them.
constexpr Real kShare = 5e-5L;
Real off_umps(const ExactEffect& effect) { return 3 * std::max<Real>(1, effect.kappa0); }
Real left_out(Real e) { return 0.022L * std::fabs(e * e * e); }

ParameterSet with(double e, double kappa0 = 0.12) {
  ParameterSet set;
  set.set(Param::e, static_cast<std::int32_t>(std::lround(std::ldexp(e, 30))));
  set.set(Param::kappa0, static_cast<std::int32_t>(std::lround(1e6 * kappa0)));
  return set;
}

Real inverse(const EffectiveBase& base, std::int32_t sum_umps, std::int32_t difference_umps) {
  return 1 + std::ldexp(static_cast<Real>(base.inverse_32(sum_umps, difference_umps)), -32);
}

Real widening(const EffectiveBase& base, std::int32_t v_umps, std::int32_t half_4umps) {
  return 1 + std::ldexp(static_cast<Real>(base.widening_32(v_umps, half_4umps)), -32);
}

TEST(EffectiveBase, WithoutAnEffectIsAlwaysB) {
  EXPECT_FALSE(EffectiveBase().varies());
  EXPECT_FALSE(EffectiveBase(ParameterSet::defaults()).varies());
  ParameterSet smallest;
  smallest.set(Param::e, -1);
  EXPECT_TRUE(EffectiveBase(smallest).varies());
}

TEST(EffectiveBase, OfASpinAndOfARobotAtRestIsB) {
  for (const double e : {-0.2, -0.03, 0.03, 0.2})
    for (const double kappa0 : {0.01, 0.12, 10.0}) {
      const EffectiveBase base(with(e, kappa0));
      for (const std::int32_t speed : {0, 1, 1000, 1'000'000, 100'000'000, 1'000'000'000}) {
        EXPECT_EQ(base.inverse_32(0, speed), 0) << e << " " << kappa0 << " " << speed;
        EXPECT_EQ(base.inverse_32(0, -speed), 0) << e << " " << kappa0 << " " << speed;
        EXPECT_EQ(base.widening_32(0, speed), 0) << e << " " << kappa0 << " " << speed;
        EXPECT_EQ(base.widening_32(0, -speed), 0) << e << " " << kappa0 << " " << speed;
      }
    }
}

TEST(EffectiveBase, OfAGentleArcIsBTimesOnePlusE) {
  for (const double e : {-0.2, -0.03, 0.03, 0.2})
    for (const double kappa0 : {0.01, 0.12, 10.0})
      for (const std::int32_t speed : {-20'000'000, -300'000, 300'000, 20'000'000}) {
        const EffectiveBase base(with(e, kappa0));
        EXPECT_NEAR(static_cast<double>(inverse(base, 2 * speed, 0)), 1 / (1 + e),
                    5e-5 * std::abs(e / (1 + e)));
        EXPECT_NEAR(static_cast<double>(widening(base, speed, 0)), 1 + e, 5e-5 * std::abs(e));
      }
}

TEST(EffectiveBase, HalfOfEActsAtTheCurvatureKappa0) {
  const EffectiveBase base(with(0.03, 0.12));
  // |R - L| = 0.12 (R + L) / 2
  EXPECT_NEAR(static_cast<double>(inverse(base, 1'000'000, 60'000)), 1 / 1.015, 2e-6);
}

TEST(EffectiveBase, DoesNotDependOnTheSensesOfDrivingAndTurning) {
  tests::Seeded random(1);
  const EffectiveBase base(with(0.03));
  for (int i = 0; i < 1000; ++i) {
    const std::int32_t sum = random.between32(1, 1'000'000), difference = random.between32(1, 1'000'000);
    const Real one = base.inverse_32(sum, difference);
    // A negative speed is taken 1 um/s smaller.
    const Real bound = std::ldexp(0.03L, 32) * (kShare + 2.0L / static_cast<Real>(std::min(sum, difference)));
    for (const auto& [s, d] : {std::pair{sum, -difference}, {-sum, difference}, {-sum, -difference}})
      ASSERT_PRED_FORMAT3(tests::near, base.inverse_32(s, d), one, bound) << s << " " << d;
  }
}

TEST(EffectiveBase, OfAnyWheelSpeedsIsThatOfTheDefinition) {
  tests::Seeded random(2);
  for (int i = 0; i < 200'000; ++i) {
    ParameterSet set;
    tests::draw_effect(set, random);
    const ExactEffect exact(set);
    // From a um/s to 500 m/s: beyond, the sum saturates.
    const auto left = static_cast<std::int32_t>(random.any_size(29)),
               right = static_cast<std::int32_t>(random.any_size(29));
    const Real difference = std::fabs(static_cast<Real>(right) - left);
    const Real narrowing = std::fabs(exact.e / (1 + exact.e));
    ASSERT_PRED_FORMAT3(tests::near, inverse(EffectiveBase(set), right + left, right - left),
                        1 / exact.over_b(left, right),
                        narrowing * (kShare + off_umps(exact) / std::max<Real>(1, difference)) + kRounding)
        << left << " " << right << " " << static_cast<double>(exact.e) << " "
        << static_cast<double>(exact.kappa0);
  }
}

TEST(EffectiveBase, OfSpeedsThatSaturatedStaysBetweenBothEnds) {
  for (const double e : {-0.2, 0.2})
    for (const double kappa0 : {0.01, 0.12, 10.0}) {
      const EffectiveBase base(with(e, kappa0));
      for (const std::int32_t sum : {INT32_MIN, -1, 0, INT32_MAX})
        for (const std::int32_t difference : {INT32_MIN, -1, 0, INT32_MAX})
          for (const Real over_b :
               {1 / inverse(base, sum, difference), widening(base, sum, difference / 4)}) {
            EXPECT_GE(over_b, 1 + std::min(e, 0.0) - 1e-5);
            EXPECT_LE(over_b, 1 + std::max(e, 0.0) + 1e-5);
          }
    }
}

TEST(EffectiveBase, OfAnyTwistIsThatOfTheWheelSpeedsItNeeds) {
  tests::Seeded random(3);
  for (int i = 0; i < 200'000; ++i) {
    ParameterSet set;
    tests::draw_effect(set, random);
    const ExactEffect exact(set);
    const auto v = static_cast<std::int32_t>(random.any_size(27)),
               half_4 = static_cast<std::int32_t>(random.any_size(27));
    const Real half = 4 * std::fabs(static_cast<Real>(half_4));
    const Real got = widening(EffectiveBase(set), v, half_4), expected = exact.over_b_of_twist(v, 2 * half);
    ASSERT_PRED_FORMAT3(tests::near, got, expected,
                        std::fabs(exact.e) * (kShare + (10 + exact.kappa0) / std::max<Real>(1, half)) +
                            left_out(exact.e) + kRounding)
        << v << " " << half_4 << " " << static_cast<double>(exact.e) << " "
        << static_cast<double>(exact.kappa0);
  }
}

}  // namespace
}  // namespace astro
