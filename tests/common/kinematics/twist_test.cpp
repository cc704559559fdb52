#include "common/kinematics/twist.hpp"

#include <gtest/gtest.h>

#include "tests/common/kinematics/near.hpp"

namespace astro {
namespace {

using tests::Real;

struct Drawn {
  Geometry geometry;
  Real base_m;
};

Drawn draw(tests::Seeded& random) {
  const ParameterSet set = tests::random_robot(random);
  return {make_geometry(set), set.get(Param::b) * 1e-9L};
}

constexpr std::int32_t kFastest_umps = 20'000'000, kFastest_uradps = 50'000'000;

TEST(Twist, WheelSpeedsAreThoseOfTheFormula) {
  tests::Seeded random(1);
  for (int i = 0; i < 50'000; ++i) {
    const auto [geometry, base_m] = draw(random);
    const BodyTwist twist{random.between32(-kFastest_umps, kFastest_umps),
                          random.between32(-kFastest_uradps, kFastest_uradps)};
    const WheelSpeeds got = to_wheels(geometry, twist);
    const Real half = twist.omega_uradps * base_m / 2;
    const Real bound = 0.5L + 0x1p-31L * std::abs(twist.omega_uradps) + 1e-6L;  // result; b/2 in 2^-30 m
    ASSERT_PRED_FORMAT3(tests::near, got.left_umps, twist.v_umps - half, bound);
    ASSERT_PRED_FORMAT3(tests::near, got.right_umps, twist.v_umps + half, bound);
  }
}

TEST(Twist, BodyToWheelsAndBackIsTheSameTwist) {
  tests::Seeded random(2);
  for (int i = 0; i < 50'000; ++i) {
    const auto [geometry, base_m] = draw(random);
    const BodyTwist twist{random.between32(-kFastest_umps, kFastest_umps),
                          random.between32(-kFastest_uradps, kFastest_uradps)};
    const BodyTwist back = to_body(geometry, to_wheels(geometry, twist));
    ASSERT_EQ(back.v_umps, twist.v_umps);
    // A wheel's half um/s on either side is 1/b; the rest is the rounding of b/2 and 1/b.
    const Real relative = 0x1p-30L / base_m + 0x1p-26L * base_m;
    ASSERT_PRED_FORMAT3(tests::near, back.omega_uradps, twist.omega_uradps,
                        1 / base_m + 0.5L + 1.01L * relative * std::abs(twist.omega_uradps));
  }
}

// As effective_base.hpp states: both ways a share of e that is 5e-5 too small and a few um/s at the wheels; and once what
// the series leaves out.
TEST(Twist, BodyToWheelsAndBackIsTheSameTwistWithACurvatureEffect) {
  tests::Seeded random(6);
  for (int i = 0; i < 200'000; ++i) {
    ParameterSet set = tests::random_robot(random);
    tests::draw_effect(set, random);
    const tests::ExactEffect effect(set);
    const Real base_m = set.get(Param::b) * 1e-9L, e = std::fabs(effect.e);
    const Geometry geometry = make_geometry(set);
    const int bits = static_cast<int>(random.between(10, 24));  // 1 mm/s to 17 m/s
    const BodyTwist twist{static_cast<std::int32_t>(random.any_size(bits)),
                          static_cast<std::int32_t>(random.any_size(bits + 1))};
    const BodyTwist back = to_body(geometry, to_wheels(geometry, twist));
    ASSERT_EQ(back.v_umps, twist.v_umps);
    const Real relative = 0x1p-30L / base_m + 0x1p-26L * base_m + 1.3L * e * 1e-4L + 0.022L * e * e * e;
    const Real wheels_umps = 1 + 1.3L * e * (2 * (10 + effect.kappa0) + 3 * std::max<Real>(1, effect.kappa0));
    ASSERT_PRED_FORMAT3(tests::near, back.omega_uradps, twist.omega_uradps,
                        1.3L * wheels_umps / base_m + 1 + 1.01L * relative * std::abs(twist.omega_uradps))
        << twist.v_umps << " " << twist.omega_uradps << " e " << static_cast<double>(effect.e) << " kappa0 "
        << static_cast<double>(effect.kappa0);
  }
}

TEST(Twist, WithACurvatureEffectASpinStillTurnsAboutB) {
  tests::Seeded random(7);
  for (int i = 0; i < 10'000; ++i) {
    ParameterSet set = tests::random_robot(random);
    const Geometry without = make_geometry(set);
    tests::draw_effect(set, random);
    const Geometry with_effect = make_geometry(set);
    const BodyTwist spin{0, random.between32(-kFastest_uradps, kFastest_uradps)};
    ASSERT_EQ(to_wheels(with_effect, spin), to_wheels(without, spin));
    const WheelSpeeds wheels = to_wheels(without, spin);
    ASSERT_EQ(to_body(with_effect, wheels), to_body(without, wheels));
  }
}

// Limits are of the body, over_speed is of a wheel. A wheelbase that is wider in curves makes the outer wheel faster by at
// most e of the turn's share, and by at most e kappa0 / 2 of the speed, because gentle curves alone are wider.
TEST(Twist, ACurvatureEffectMakesNoWheelFasterThanItsWidestBase) {
  tests::Seeded random(8);
  for (int i = 0; i < 200'000; ++i) {
    ParameterSet set = tests::random_robot(random);
    const Geometry without = make_geometry(set);
    tests::draw_effect(set, random);
    const tests::ExactEffect effect(set);
    const BodyTwist twist{random.between32(-kFastest_umps, kFastest_umps),
                          random.between32(-kFastest_uradps, kFastest_uradps)};
    const auto fastest = [&](const Geometry& geometry) {
      const WheelSpeeds wheels = to_wheels(geometry, twist);
      return std::max(std::fabs(static_cast<Real>(wheels.left_umps)),
                      std::fabs(static_cast<Real>(wheels.right_umps)));
    };
    const Real v = std::fabs(static_cast<Real>(twist.v_umps)), turn = fastest(without) - v,
               wider = std::max<Real>(effect.e, 0);
    // The error of the series, of the share and of a wheel's speed, as effective_base.hpp states them.
    const Real off = turn * (5e-5L + 0.022L * wider * wider) * wider + wider * (10 + effect.kappa0) + 2;
    ASSERT_LE(fastest(make_geometry(set)), v + turn * (1 + wider) + off);
    ASSERT_LE(fastest(make_geometry(set)), v * (1 + wider * effect.kappa0 / 2) + turn + off);
  }
}

TEST(Twist, StraightIsTheSameNumberOnBothWheelsWithACurvatureEffect) {
  tests::Seeded random(9);
  for (int i = 0; i < 10'000; ++i) {
    ParameterSet set = tests::random_robot(random);
    tests::draw_effect(set, random);
    const std::int32_t v = random.between32(-kFastest_umps, kFastest_umps);
    ASSERT_EQ(to_wheels(make_geometry(set), {v, 0}), (WheelSpeeds{v, v}))
        << "full speed stays below over_speed";
  }
}

TEST(Twist, WheelsToBodyAndBackAreTheSameSpeeds) {
  tests::Seeded random(3);
  for (int i = 0; i < 50'000; ++i) {
    const auto [geometry, base_m] = draw(random);
    // As fast as wheels go whose robot turns at no more than 50 rad/s: beyond, omega saturates.
    const auto most = static_cast<std::int32_t>(base_m * 25'000'000);
    const WheelSpeeds wheels{random.between32(-most, most), random.between32(-most, most)};
    const WheelSpeeds back = to_wheels(geometry, to_body(geometry, wheels));
    const Real half_difference = std::fabs(static_cast<Real>(wheels.right_umps) - wheels.left_umps) / 2;
    const Real relative = 0x1p-30L / base_m + 0x1p-26L * base_m;
    // 1/2 in v, 1/2 of omega times b/2, 1/2 of rounding the product
    const Real bound = 1 + base_m / 4 + 1.01L * relative * half_difference;
    ASSERT_PRED_FORMAT3(tests::near, back.left_umps, wheels.left_umps, bound);
    ASSERT_PRED_FORMAT3(tests::near, back.right_umps, wheels.right_umps, bound);
  }
}

TEST(Twist, APureSpinHasEqualAndOppositeWheelsAndNoForwardSpeed) {
  tests::Seeded random(4);
  for (int i = 0; i < 50'000; ++i) {
    const auto [geometry, base_m] = draw(random);
    const WheelSpeeds wheels = to_wheels(geometry, {0, random.between32(-kFastest_uradps, kFastest_uradps)});
    ASSERT_EQ(wheels.left_umps, -wheels.right_umps);
    ASSERT_EQ(to_body(geometry, wheels).v_umps, 0);
  }
}

TEST(Twist, StraightIsTheSameNumberOnBothWheels) {
  tests::Seeded random(5);
  for (int i = 0; i < 10'000; ++i) {
    const Geometry geometry = draw(random).geometry;
    const std::int32_t v = random.between32(-kFastest_umps, kFastest_umps);
    ASSERT_EQ(to_wheels(geometry, {v, 0}), (WheelSpeeds{v, v}));
    ASSERT_EQ(to_body(geometry, {v, v}), (BodyTwist{v, 0}));
  }
}

TEST(Twist, ExtremesSaturateAndDoNotTurnAround) {
  const Geometry geometry = make_geometry(ParameterSet::defaults());
  for (const std::int32_t v : {INT32_MIN, INT32_MAX})
    for (const std::int32_t omega : {INT32_MIN, INT32_MAX}) {
      const WheelSpeeds wheels = to_wheels(geometry, {v, omega});
      EXPECT_EQ(wheels.right_umps > 0, v > 0) << v << " " << omega;  // b/2 < 1: v leads
      EXPECT_EQ(wheels.left_umps > 0, v > 0) << v << " " << omega;
    }
  EXPECT_EQ(to_body(geometry, {INT32_MIN, INT32_MAX}).omega_uradps, INT32_MAX);
  EXPECT_EQ(to_body(geometry, {INT32_MAX, INT32_MIN}).omega_uradps, INT32_MIN);
}

}  // namespace
}  // namespace astro
