#include "common/control/trapezoid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/common/control/astro_motion.hpp"
#include "tests/common/fixed/seeded.hpp"

namespace astro {
namespace {

using Int128 = __int128;
using Step = Trapezoid::Step;
using tests::kAstro;
using tests::kMetre_nm;
using tests::kTurn_32;

constexpr double kTwoPi = 2 * std::numbers::pi;

std::vector<Step> steps_of(const Segment& segment, const MotionLimits& limits) {
  Trapezoid profile;
  EXPECT_TRUE(Trapezoid::plan(segment, limits, profile));
  std::vector<Step> steps;
  while (!profile.done()) steps.push_back(profile.advance());
  EXPECT_EQ(static_cast<std::int64_t>(steps.size()), profile.ticks());
  return steps;
}

Step sum(const std::vector<Step>& steps) {
  Step total;
  for (const Step& step : steps) total = {total.travel + step.travel, total.turn + step.turn};
  return total;
}

/// 2^-50 m, 2^-52 turn.
Step exact_total(const Segment& segment) {
  const Int128 scaled = (Int128{segment.length_nm} << 51) / kMetre_nm;  // one bit too many, towards zero
  const auto rounded = static_cast<std::int64_t>((scaled + (scaled < 0 ? -1 : 1)) / 2);
  return {rounded, segment.angle_32 << 20};
}

struct Peaks {
  double speed_mps = 0, acceleration_mps2 = 0, yaw_rate_radps = 0, yaw_acceleration_radps2 = 0;
};

/// From rest to rest: the first step comes from zero and the last one goes to zero.
Peaks peaks_of(const std::vector<Step>& steps) {
  Peaks peaks;
  Step before;
  const auto see = [&](const Step& step) {
    const auto raise = [](double& peak, std::int64_t value, double unit) {
      peak = std::max(peak, std::fabs(static_cast<double>(value)) * unit);
    };
    raise(peaks.speed_mps, step.travel, 0x1p-50 * 1e3);
    raise(peaks.acceleration_mps2, step.travel - before.travel, 0x1p-50 * 1e6);
    raise(peaks.yaw_rate_radps, step.turn, 0x1p-52 * kTwoPi * 1e3);
    raise(peaks.yaw_acceleration_radps2, step.turn - before.turn, 0x1p-52 * kTwoPi * 1e6);
    before = step;
  };
  for (const Step& step : steps) see(step);
  see({});
  return peaks;
}

MotionLimits random_limits(tests::Seeded& random) {
  const auto draw = [&](Param id) {  // even in the logarithm: the slow ends are as likely as the fast ones
    const ParamRow& row = param_row(id);
    const double low = row.minimum_raw, high = row.maximum_raw;
    const double part = static_cast<double>(random.bits() >> 11) * 0x1p-53;
    return static_cast<std::int32_t>(low * std::pow(high / low, part));
  };
  return {draw(Param::speed_limit), draw(Param::yaw_rate_limit), draw(Param::acceleration_limit),
          draw(Param::yaw_acceleration_limit)};
}

/// Any shape of at most `most_m` and `most_turns`, of every order of magnitude, sometimes slower than the
/// limits.
Segment random_segment(tests::Seeded& random, double most_m, double most_turns) {
  const auto draw = [&](double most) {
    const double part = static_cast<double>(random.bits() >> 11) * 0x1p-53;
    const double size = most * std::pow(10, -7 * part);
    return static_cast<std::int64_t>((random.bits() & 1U) != 0 ? size : -size);
  };
  Segment segment;
  const std::int64_t shape = random.between(0, 2);
  if (shape != 1) segment.length_nm = draw(most_m * 1e9);
  if (shape != 0) segment.angle_32 = draw(most_turns * 0x1p32);
  if (random.between(0, 3) == 0) segment.speed_umps = random.between32(1'000, 10'000'000);
  if (random.between(0, 3) == 0) segment.yaw_rate_uradps = random.between32(1'000, 50'000'000);
  return segment;
}

template <class Check>
void for_random_plans(std::uint64_t seed, int count, Check check) {
  tests::Seeded random(seed);
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const MotionLimits limits = random_limits(random);
    const Segment segment = random_segment(random, 20, 5);
    Trapezoid profile;
    if (!Trapezoid::plan(segment, limits, profile) || profile.ticks() > 300'000) continue;  // five minutes
    SCOPED_TRACE(testing::Message() << segment.length_nm << " nm, " << segment.angle_32
                                    << " / 2^32 turn, at most " << segment.speed_umps << ", "
                                    << segment.yaw_rate_uradps << "; limits " << limits.speed_umps << " "
                                    << limits.yaw_rate_uradps << " " << limits.acceleration_umps2 << " "
                                    << limits.yaw_acceleration_uradps2);
    check(segment, limits, steps_of(segment, limits));
  }
}

TEST(Trapezoid, StepsAddUpToTheSegmentExactly) {
  for_random_plans(1, 2000, [](const Segment& segment, const MotionLimits&, const std::vector<Step>& steps) {
    EXPECT_EQ(sum(steps).travel, exact_total(segment).travel);
    EXPECT_EQ(sum(steps).turn, exact_total(segment).turn);
  });
}

TEST(Trapezoid, KeepsEveryLimit) {
  for_random_plans(
      2, 2000, [](const Segment& segment, const MotionLimits& limits, const std::vector<Step>& steps) {
        const Peaks peaks = peaks_of(steps);
        const auto tighter = [](std::int32_t wanted, std::int32_t limit) {
          return (wanted > 0 ? std::min(wanted, limit) : limit) * 1e-6;
        };
        // The plan rounds to the slow side only; 1e-9 is this test's double, and steps are whole numbers of
        // 2^-50 m or
        // 2^-52 turn, of which the difference of two may have two too many.
        constexpr double kMore = 1 + 1e-9, kUnit_mps = 1e-12, kUnits_mps2 = 4e-9;
        EXPECT_LE(peaks.speed_mps, tighter(segment.speed_umps, limits.speed_umps) * kMore + kUnit_mps);
        EXPECT_LE(peaks.yaw_rate_radps,
                  tighter(segment.yaw_rate_uradps, limits.yaw_rate_uradps) * kMore + kUnit_mps);
        EXPECT_LE(peaks.acceleration_mps2, limits.acceleration_umps2 * 1e-6 * kMore + kUnits_mps2);
        EXPECT_LE(peaks.yaw_acceleration_radps2,
                  limits.yaw_acceleration_uradps2 * 1e-6 * kMore + kUnits_mps2);
      });
}

TEST(Trapezoid, UpAndDownAreMirrorImages) {
  for_random_plans(3, 1000, [](const Segment&, const MotionLimits&, const std::vector<Step>& steps) {
    for (std::size_t i = 1; i < steps.size() / 2; ++i) {  // the last step takes what is left
      ASSERT_LE(std::abs(steps[i].travel - steps[steps.size() - 1 - i].travel), 1);
      ASSERT_LE(std::abs(steps[i].turn - steps[steps.size() - 1 - i].turn), 1);
    }
  });
}

TEST(Trapezoid, BackwardIsForwardWithTheOtherSign) {
  for_random_plans(4, 500,
                   [](const Segment& segment, const MotionLimits& limits, const std::vector<Step>& steps) {
                     Segment back = segment;
                     back.length_nm = -segment.length_nm;
                     back.angle_32 = -segment.angle_32;
                     const std::vector<Step> mirrored = steps_of(back, limits);
                     ASSERT_EQ(mirrored.size(), steps.size());
                     for (std::size_t i = 0; i < steps.size(); ++i) {
                       ASSERT_LE(std::abs(steps[i].travel + mirrored[i].travel), 1);
                       ASSERT_LE(std::abs(steps[i].turn + mirrored[i].turn), 1);
                     }
                   });
}

TEST(Trapezoid, AnArcKeepsItsCurvatureInEveryStep) {
  for_random_plans(5, 2000, [](const Segment& segment, const MotionLimits&, const std::vector<Step>& steps) {
    const Step total = exact_total(segment);
    const auto magnitude = [](Int128 value) { return value < 0 ? -value : value; };
    // travel / turn of a step is that of the whole but for a unit in either and the 2^-18 units that each of
    // its shares may err by; the last step takes what is left.
    const Int128 one_unit = magnitude(total.travel) + magnitude(total.turn);
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
      const Int128 cross = Int128{steps[i].travel} * total.turn - Int128{steps[i].turn} * total.travel;
      ASSERT_TRUE(magnitude(cross) <= one_unit + one_unit / 65'536 * static_cast<std::int64_t>(i + 1)) << i;
    }
  });
}

TEST(Trapezoid, SpeedRisesStaysAndFalls) {
  for_random_plans(6, 500, [](const Segment& segment, const MotionLimits&, const std::vector<Step>& steps) {
    const std::int64_t sign = segment.length_nm < 0 ? -1 : 1;
    bool falling = false;
    for (std::size_t i = 1; i + 1 < steps.size(); ++i) {  // the last step takes what is left
      const std::int64_t change = sign * (steps[i].travel - steps[i - 1].travel);
      falling = falling || change < -1;
      ASSERT_LE(change, falling ? 1 : INT64_MAX) << i;
      ASSERT_GE(sign * steps[i].travel, 0) << i;
    }
  });
}

TEST(Trapezoid, ALongLineTakesTheTimeOfTheFormula) {
  // d / v + v / a = 3 / 0.75 + 0.75 / 0.5 s
  EXPECT_EQ(steps_of({3 * kMetre_nm, 0, 0, 0}, kAstro).size(), 5500U);
  EXPECT_NEAR(peaks_of(steps_of({3 * kMetre_nm, 0, 0, 0}, kAstro)).speed_mps, 0.75, 1e-6);
}

TEST(Trapezoid, AShortLineIsATriangle) {
  // 2 sqrt(d / a) = 2 sqrt(0.1 / 0.5) s, reaching sqrt(0.1 * 0.5) m/s
  const std::vector<Step> steps = steps_of({kMetre_nm / 10, 0, 0, 0}, kAstro);
  EXPECT_NEAR(static_cast<double>(steps.size()), 2000 * std::sqrt(0.2), 2);
  EXPECT_NEAR(peaks_of(steps).speed_mps, std::sqrt(0.05), 1e-3);
}

TEST(Trapezoid, ASpinAndAnArcTakeTheTighterLimit) {
  EXPECT_NEAR(peaks_of(steps_of({0, kTurn_32, 0, 0}, kAstro)).yaw_rate_radps, 2.0, 1e-3);  // whole ticks
  // Radius 0.2 m: 2 rad/s is reached at 0.4 m/s.
  const auto circle_nm = static_cast<std::int64_t>(kTwoPi * 0.2e9);
  const Peaks tight = peaks_of(steps_of({circle_nm, kTurn_32, 0, 0}, kAstro));
  EXPECT_NEAR(tight.yaw_rate_radps, 2.0, 2e-3);
  EXPECT_NEAR(tight.speed_mps, 0.4, 1e-3);
  // Radius 2 m: the speed limit comes first.
  const Peaks wide = peaks_of(steps_of({10 * circle_nm, kTurn_32, 0, 0}, kAstro));
  EXPECT_NEAR(wide.speed_mps, 0.75, 1e-3);
  EXPECT_NEAR(wide.yaw_rate_radps, 0.375, 1e-3);
}

TEST(Trapezoid, TheSegmentsOwnSpeedHoldsWhenSlowerAndNotWhenFaster) {
  EXPECT_NEAR(peaks_of(steps_of({3 * kMetre_nm, 0, 200'000, 0}, kAstro)).speed_mps, 0.2, 1e-4);
  EXPECT_NEAR(peaks_of(steps_of({3 * kMetre_nm, 0, 5'000'000, 0}, kAstro)).speed_mps, 0.75, 1e-4);
}

TEST(Trapezoid, RefusesWhatIsEmptyTooLongOrTooSlow) {
  Trapezoid untouched;
  EXPECT_FALSE(Trapezoid::plan({}, kAstro, untouched));
  EXPECT_FALSE(Trapezoid::plan({kMaxLength_nm + 1, 0, 0, 0}, kAstro, untouched));
  EXPECT_FALSE(Trapezoid::plan({-kMaxLength_nm - 1, 0, 0, 0}, kAstro, untouched));
  EXPECT_FALSE(Trapezoid::plan({0, kMaxAngle_32 + 1, 0, 0}, kAstro, untouched));
  EXPECT_FALSE(Trapezoid::plan({INT64_MIN, 0, 0, 0}, kAstro, untouched));
  EXPECT_FALSE(Trapezoid::plan({0, INT64_MIN, 0, 0}, kAstro, untouched));
  EXPECT_FALSE(Trapezoid::plan({INT64_MAX, INT64_MAX, 0, 0}, kAstro, untouched));
  EXPECT_FALSE(Trapezoid::plan({kMaxLength_nm, 0, 1'000, 0}, kAstro, untouched)) << "278 hours";
  EXPECT_TRUE(untouched.done());
}

TEST(Trapezoid, TakesTheLongestTheFarthestAndTheSmallest) {
  Trapezoid profile;
  EXPECT_TRUE(Trapezoid::plan({kMaxLength_nm, 0, 0, 0}, kAstro, profile));
  EXPECT_TRUE(Trapezoid::plan({-kMaxLength_nm, kMaxAngle_32, 0, 0}, kAstro, profile));
  for (const std::int64_t small : {std::int64_t{1}, std::int64_t{999}, std::int64_t{-1001}}) {
    EXPECT_EQ(sum(steps_of({small, 0, 0, 0}, kAstro)).travel, exact_total({small, 0, 0, 0}).travel);
    EXPECT_EQ(sum(steps_of({0, small, 0, 0}, kAstro)).turn, small << 20);
  }
}

TEST(Trapezoid, StandsForAsLongAsTheLongestSegmentAndNoLonger) {
  Trapezoid profile;
  EXPECT_TRUE(Trapezoid::plan({.dwell_ms = 1}, kAstro, profile));
  EXPECT_EQ(profile.ticks(), 1);
  EXPECT_TRUE(Trapezoid::plan({.dwell_ms = kMaxTicks}, kAstro, profile));
  EXPECT_EQ(profile.ticks(), 14'400'000) << "four hours";
  EXPECT_FALSE(Trapezoid::plan({.dwell_ms = kMaxTicks + 1}, kAstro, profile));
  EXPECT_FALSE(Trapezoid::plan({.dwell_ms = -1}, kAstro, profile));
  EXPECT_FALSE(Trapezoid::plan({.length_nm = 1, .dwell_ms = 1}, kAstro, profile)) << "moves and stands";
  EXPECT_FALSE(Trapezoid::plan({.angle_32 = 1, .dwell_ms = 1}, kAstro, profile)) << "turns and stands";
  EXPECT_EQ(kMaxLength_nm, 1'000'000'000'000) << "a kilometre";
  EXPECT_EQ(kMaxAngle_32, 500 * kTurn_32) << "500 turns";
}

TEST(Trapezoid, TakesItsOwnSpeedJustBelowTheLimitAndTheLimitJustAboveIt) {
  // 3 m in one go: cruise ticks are length over speed, and the ramps 1.5 s at 0.5 m/s^2.
  const auto ticks = [](std::int32_t speed_umps) {
    return steps_of({3 * kMetre_nm, 0, speed_umps, 0}, kAstro).size();
  };
  EXPECT_EQ(ticks(750'001), ticks(0));
  EXPECT_EQ(ticks(750'000), ticks(0));
  EXPECT_GT(ticks(740'000), ticks(0));
}

TEST(Trapezoid, IsOneTickOfRampLongerThanATriangleOnlyWhereItHasALevelPart) {
  // v^2 / a = 1.125 m is the longest line without a level part at 0.75 m/s and 0.5 m/s^2.
  const Peaks below = peaks_of(steps_of({1'100'000'000, 0, 0, 0}, kAstro));
  EXPECT_NEAR(below.speed_mps, std::sqrt(1.1 * 0.5), 0.001);
  const Peaks above = peaks_of(steps_of({1'150'000'000, 0, 0, 0}, kAstro));
  EXPECT_NEAR(above.speed_mps, 0.75, 0.001);
}

/// What a profile that is cut short after so many ticks still drives, and what is left then, in nanometres.
struct Cut {
  std::int64_t ticks_more = 0, driven_nm = 0, rest_nm = 0;
};
Cut cut_after(const Segment& segment, std::int64_t ticks) {
  Trapezoid profile;
  EXPECT_TRUE(Trapezoid::plan(segment, kAstro, profile));
  Int128 travel = 0;
  for (std::int64_t i = 0; i < ticks; ++i) travel += profile.advance().travel;
  profile.cut_short();
  Cut cut;
  for (; !profile.done(); ++cut.ticks_more) travel += profile.advance().travel;
  cut.driven_nm = static_cast<std::int64_t>((travel * kMetre_nm) >> 50);
  cut.rest_nm = profile.rest().length_nm;
  return cut;
}

TEST(Trapezoid, CutShortComesToRestAsSteeplyAsItWouldAndTheRestIsWhatIsLeft) {
  const Segment line{3 * kMetre_nm, 0, 0, 0};  // 1500 ticks up, 2500 level, 1500 down
  EXPECT_EQ(cut_after(line, 0).ticks_more, 0);
  EXPECT_EQ(cut_after(line, 1).ticks_more, 1);
  EXPECT_EQ(cut_after(line, 700).ticks_more, 700);
  EXPECT_EQ(cut_after(line, 1499).ticks_more, 1499);
  for (const std::int64_t ticks : {1500, 1501, 3000, 3999, 4000})
    EXPECT_EQ(cut_after(line, ticks).ticks_more, 1500);
  for (const std::int64_t ticks : {4001, 5000, 5499, 5500})
    EXPECT_EQ(cut_after(line, ticks).ticks_more, 5500 - ticks);
  for (const std::int64_t ticks : {0, 1, 700, 1500, 3000, 3999}) {
    const Cut cut = cut_after(line, ticks);
    EXPECT_NEAR(static_cast<double>(cut.driven_nm + cut.rest_nm), 3e9, 2) << ticks;
    EXPECT_GT(cut.rest_nm, 0);
  }
  for (const std::int64_t ticks : {4000, 5000, 5500}) EXPECT_EQ(cut_after(line, ticks).rest_nm, 0) << ticks;
}

TEST(Trapezoid, OfAStandThatIsCutShortTheRestOfItsTimeIsLeft) {
  Trapezoid profile;
  ASSERT_TRUE(Trapezoid::plan({.dwell_ms = 100}, kAstro, profile));
  for (int i = 0; i < 30; ++i) profile.advance();
  EXPECT_EQ(profile.rest().dwell_ms, 70);
  profile.cut_short();
  EXPECT_TRUE(profile.done());
  EXPECT_EQ(profile.rest().dwell_ms, 70);
}

TEST(Trapezoid, ProgressGoesFromNothingToTheWholeByTheWayGivenOrByTheTime) {
  for (const Segment& segment : {Segment{-kMetre_nm, 0, 0, 0}, Segment{0, kTurn_32, 0, 0},
                                 Segment{2 * kMetre_nm, -kTurn_32, 0, 0}, Segment{.dwell_ms = 1000}}) {
    Trapezoid profile;
    ASSERT_TRUE(Trapezoid::plan(segment, kAstro, profile));
    EXPECT_EQ(profile.progress_16(), 0U);
    const std::int64_t half = profile.ticks() / 2;
    for (std::int64_t i = 0; i < half; ++i) profile.advance();
    EXPECT_NEAR(profile.progress_16(), 32'768, 70);  // profiles are symmetric; one tick in 1000 more or less
    while (!profile.done()) profile.advance();
    EXPECT_NEAR(profile.progress_16(), 65'536, 1);
  }
  EXPECT_EQ(Trapezoid{}.progress_16(), 0U);
}

TEST(Trapezoid, NothingTakesLongerThanFourHours) {
  tests::Seeded random(7);
  int taken = 0;
  for (int i = 0; i < 100'000; ++i) {
    Trapezoid profile;
    if (!Trapezoid::plan(random_segment(random, 1000, 500), random_limits(random), profile)) continue;
    ASSERT_LE(profile.ticks(), kMaxTicks);
    ++taken;
  }
  EXPECT_GT(taken, 50'000);
  // Just inside by its level speed alone: the ramps must be counted too.
  Trapezoid profile;
  EXPECT_FALSE(
      Trapezoid::plan({kMaxTicks * 10'000, 0, 10'000, 0}, {10'000, 2'000'000, 10'000, 3'000'000}, profile));
}

TEST(Trapezoid, ASlowLongLineEndsAsGentlyAsItBegan) {
  // The slowest ramps there are: many shares, so that what one step rounds away is much when all of it comes
  // at once.
  const MotionLimits slow{10'000, 10'000, 10'000, 10'000};
  for (const Segment& segment : {Segment{2 * kMetre_nm + 1, 0, 0, 0}, Segment{0, kTurn_32 / 2 + 1, 0, 0},
                                 Segment{-kMetre_nm - 7, kTurn_32 / 8 + 1, 0, 0}}) {
    const Peaks peaks = peaks_of(steps_of(segment, slow));
    EXPECT_LE(peaks.acceleration_mps2, 0.01001);
    EXPECT_LE(peaks.yaw_acceleration_radps2, 0.01001);
  }
}

}  // namespace
}  // namespace astro
