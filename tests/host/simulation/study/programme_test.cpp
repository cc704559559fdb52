#include "host/simulation/study/programme.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "host/base/require_positive.hpp"
#include "host/simulation/study/kinematic_source.hpp"
#include "host/simulation/study/limits.hpp"
#include "host/simulation/study/shortest_programme.hpp"
#include "host/simulation/study/summary.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::simulation::study {
namespace {

using calibration::Precision;
using support::Tells;
using support::told_by;

Forecast of(const Counts& counts) { return forecast(Programme{}.with(counts)); }

bool meets(const Forecast& forecast, double target) {
  const Precision reached = forecast.relative();
  return reached.E_d <= target && reached.scale <= target && reached.b <= target;
}

TEST(Forecast, OfTenSquaresIsTheBoundThatAStudyComparesWith) {
  TrialSetup setup;
  setup.E_d = setup.E_b = setup.scale = 1;
  setup.e = 1e-9;  // as good as none, but unknown
  setup.clock_known = false;
  const Row bound = bound_of(setup, KinematicSource());
  const Forecast ten = of({10, 0, 0, 0});
  EXPECT_NEAR(ten.se.E_d / bound.rms[kE_d], 1, 1e-9);
  EXPECT_NEAR(ten.se.scale / bound.rms[kScale], 1, 1e-9);
  EXPECT_NEAR(ten.se.b_over_scale_m / setup.wheelbase_m / bound.rms[kB_over_S], 1, 1e-9);
}

TEST(Forecast, OfSquaresFollowsTheDesignRules) {
  const Forecast ten = of({10, 0, 0, 0});
  const Precision reached = ten.relative();
  const Precision rule = reachable_precision(ten.extent, ten.programme.noise.K_m, ten.programme.wheelbase_m);
  EXPECT_NEAR(reached.E_d / rule.E_d, 1, 0.04);  // what precision.hpp promises
  EXPECT_NEAR(reached.scale / rule.scale, 1, 0.04);
  // The rule's b is b / S; b itself has the error of S, 1.05e-4 beside 3.8e-4, on top.
  EXPECT_NEAR(ten.se.b_over_scale_m / ten.programme.wheelbase_m / rule.b, 1, 0.04);
  EXPECT_GT(reached.b, rule.b);
}

TEST(Forecast, OfFourTimesTheRunsIsHalfTheErrorInFourTimesTheTime) {
  // No circles: these show e, of which something is known without any run.
  const Forecast few = of({2, 2, 2, 0}), many = of({8, 8, 8, 0});
  EXPECT_NEAR(many.relative().E_d / few.relative().E_d, 0.5,
              1e-6);  // all that runs share is estimated from all
  EXPECT_NEAR(many.relative().b / few.relative().b, 0.5, 1e-6);
  EXPECT_NEAR(many.driving_time_s, 4 * few.driving_time_s, 1e-9);
  EXPECT_NEAR(many.extent.distance_m, 4 * few.extent.distance_m, 1e-9);
}

TEST(Forecast, KnowsHowFarHowManyTurnsAndHowLong) {
  const double pi = std::numbers::pi;
  const Forecast f = of({0, 1, 2, 0});
  EXPECT_NEAR(f.extent.distance_m, 3, 1e-12);
  EXPECT_NEAR(f.extent.rotation_rad, 2 * 5 * 2 * pi, 1e-9);
  // Each run rests 2 s; 3 m at 0.3 m/s with a ramp of 0.6 s, five turns at 1 rad/s with a ramp of 0.5 s.
  EXPECT_NEAR(f.driving_time_s, 12.6 + 2 * (2 + 10 * pi + 0.5), 0.05);
  EXPECT_EQ(f.programme.text(), "1 line of 3 m, 2 spins of 5 turns");
}

TEST(Forecast, WorseGroundTruthAndMoreSlipTakePrecision) {
  const Programme squares = Programme{}.with({2, 0, 0, 0});
  Programme slippery = squares, blurred = squares;
  slippery.noise.K_m *= 4;
  blurred.noise.sigma_theta_rad *= 10;
  blurred.noise.sigma_xy_m *= 10;
  const Precision best = forecast(squares).relative();
  EXPECT_NEAR(forecast(slippery).relative().E_d / best.E_d, 2, 0.02) << "slip is nearly all of the noise";
  EXPECT_GT(forecast(blurred).relative().b, 1.05 * best.b);
}

TEST(Forecast, OfAnEThatIsToBeFoundIsTheBoundThatAStudyComparesWith) {
  TrialSetup setup;
  setup.E_d = setup.E_b = setup.scale = 1;
  setup.clock_known = false;
  setup.runs = setup.circles = 3;
  setup.e = 1e-9;  // as good as none, but unknown
  const Row bound = bound_of(setup, KinematicSource());
  Programme programme = Programme{}.with({6, 0, 0, 12});  // of one turn each, the study's are of two
  programme.radius_m = setup.circle_radius_m;
  programme.with_e = true;
  const Forecast found = forecast(programme);
  // Twelve circles have twice the rests and clock offsets of six.
  EXPECT_NEAR(found.se.e / bound.rms[kCurvature], 1, 0.05);
  EXPECT_NEAR(found.se.E_d / bound.rms[kE_d], 1, 0.05);
}

TEST(Forecast, OfSquaresAloneLeavesEAsUncertainAsItWas) {
  Programme programme = Programme{}.with({10, 0, 0, 0});
  const Forecast squares = forecast(programme);
  EXPECT_NEAR(squares.se.e, 0.02, 1e-3) << "what is known of tyres without a drive";
  EXPECT_EQ(why_e_is_hidden(programme.counts), "runs without circles hardly show e");
  const Forecast circles = forecast(programme.with({0, 0, 0, 10}));
  EXPECT_GT(circles.se.e, 0.019);
  EXPECT_EQ(why_e_is_hidden(circles.programme.counts),
            "runs without squares and spins hardly tell e from the wheelbase");
  const Forecast both = forecast(programme.with({6, 0, 0, 6}));
  EXPECT_LT(both.se.e, 0.01);
  EXPECT_FALSE(why_e_is_hidden(both.programme.counts));
}

TEST(ShortestProgramme, FindsEWithCircles) {
  const Precision target{1e-3, 1e-3, 1e-3};
  const std::vector<Kind> all{kSquares, kLines, kSpins, kCircles};
  const Forecast found = shortest_programme(target, all, Programme{}, 2e-3);
  EXPECT_TRUE(meets(found, 1e-3));
  EXPECT_LE(found.se.e, 2e-3);
  EXPECT_GT(found.se.e, 1.8e-3) << "and no more than it takes";
  EXPECT_GT(found.programme.counts[kCircles], 0);
  EXPECT_GT(found.programme.counts[kSquares] + found.programme.counts[kSpins], 0);
  EXPECT_GT(found.driving_time_s, shortest_programme(target, all, Programme{}).driving_time_s);
  const auto told = [&](const std::vector<Kind>& kinds) {
    return told_by([&] { (void)shortest_programme(target, kinds, Programme{}, 2e-3); });
  };
  EXPECT_THAT(told({kSquares, kLines}), Tells(ProgrammeProblem::no_circles));
  EXPECT_THAT(told({kLines, kCircles}), Tells(ProgrammeProblem::no_squares_nor_spins));
}

TEST(Forecast, RefusesProgrammesThatLeaveAFactorOpen) {
  const auto told = [](const Counts& counts) { return told_by([&] { (void)of(counts); }); };
  EXPECT_THAT(told({0, 0, 0, 0}), Tells(ProgrammeProblem::no_runs));
  EXPECT_THAT(told({0, 7, 0, 0}), Tells(ProgrammeProblem::lines_alone));
  EXPECT_THAT(told({0, 0, 7, 0}), Tells(ProgrammeProblem::spins_alone));
  EXPECT_THAT(told({0, 0, 0, 1}), Tells(ProgrammeProblem::one_circle));
  EXPECT_THAT(told({-1, 0, 0, 0}), Tells(LimitProblem::out_of_range, "the number of squares", "-1"));
  EXPECT_THAT(told({600, 600, 0, 0}), Tells(ProgrammeProblem::too_many_runs, "1200"));
  Programme vast;
  vast.side_m = 1000;
  EXPECT_THAT(told_by([&] {
                (void)forecast(vast.with({1000, 0, 0, 0}));
              }),
              Tells(LimitProblem::exceeds_memory, "3705"));
  Programme flat;
  flat.side_m = 0;
  EXPECT_THAT(told_by([&] {
                (void)forecast(flat.with({2, 0, 0, 0}));
              }),
              Tells(SettingProblem::not_positive, "the side of the squares in metres", "0"));
}

TEST(ShortestProgramme, MeetsTheTargetAndTakesNoRunTooMany) {
  for (const double target : {1e-2, 1e-3, 5e-4, 2e-4}) {
    const Forecast found =
        shortest_programme({target, target, target}, {kSquares, kLines, kSpins, kCircles}, Programme{});
    EXPECT_TRUE(meets(found, target)) << target;
    for (const Kind kind : {kSquares, kLines, kSpins, kCircles}) {
      Counts less = found.programme.counts;
      less[kind] -= kind == kLines ? 1 : 2;
      if (less[kind] < 0 || less == Counts{}) continue;
      try {
        EXPECT_FALSE(meets(of(less), target)) << target << ", without one of " << kKindNames[kind];
      } catch (const Error&) {
        // The remaining runs cannot determine all three factors.
      }
    }
  }
}

TEST(ShortestProgramme, IsTheShortestOfAllThatAreTried) {
  constexpr double kTarget = 5e-4;
  const Forecast found =
      shortest_programme({kTarget, kTarget, kTarget}, {kLines, kSpins, kCircles}, Programme{});
  for (int lines = 0; lines <= 8; ++lines)
    for (int spins = 0; spins <= 4; spins += 2)
      for (int circles = 0; circles <= 6; circles += 2) {
        if (spins + circles == 0 || lines + circles == 0) continue;
        const Forecast other = of({0, lines, spins, circles});
        if (meets(other, kTarget)) {
          EXPECT_GE(other.driving_time_s, found.driving_time_s - 1e-9) << other.programme.text();
        }
      }
}

TEST(ShortestProgramme, UsesTheKindsItMayAndFewerKindsAreNeverFaster) {
  const Precision target{3e-4, 3e-4, 3e-4};
  const Forecast all = shortest_programme(target, {kSquares, kLines, kSpins, kCircles}, Programme{});
  const Forecast squares = shortest_programme(target, {kSquares}, Programme{});
  EXPECT_EQ(squares.programme.counts[kLines] + squares.programme.counts[kSpins], 0);
  EXPECT_GE(squares.driving_time_s, all.driving_time_s);
  EXPECT_EQ(squares.programme.counts[kSquares] % 2, 0) << "as many each way";
}

TEST(ShortestProgramme, LooksAtEachOfTheThreeTargets) {
  const Precision loose{1e-2, 1e-2, 1e-2};
  for (const auto precise : {&Precision::E_d, &Precision::scale, &Precision::b}) {
    Precision target = loose;
    target.*precise = 1e-4;
    const Forecast found = shortest_programme(target, {kLines, kSpins}, Programme{});
    EXPECT_LE(found.relative().*precise, 1e-4);
    EXPECT_GT(found.relative().*precise, 0.9e-4) << "and no more than it takes";
  }
}

TEST(ShortestProgramme, RefusesWhatCannotBeReached) {
  const auto told = [](double target, const std::vector<Kind>& kinds) {
    return told_by([&] { (void)shortest_programme({target, target, target}, kinds, Programme{}); });
  };
  EXPECT_THAT(told(5e-4, {kLines}), Tells(ProgrammeProblem::lines_alone));
  EXPECT_THAT(told(1e-7, {kSquares}), Tells(ProgrammeProblem::precision_too_fine));
  EXPECT_THAT(told(0, {kSquares}), Tells(SettingProblem::not_positive, "the precision wanted of E_d", "0"));
}

}  // namespace
}  // namespace astro::simulation::study
