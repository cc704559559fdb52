#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "tests/host/calibration/end_poses/square_runs.hpp"

#include "host/base/text/numbers.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::calibration {
namespace {

using support::Tells;

using namespace test;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const std::vector<EndPose> kCw{{-0.2, -0.26, 0.15}};
const std::vector<EndPose> kCcw{{0.31, -0.26, 0.17}};
constexpr Options kExtended{Method::extended};
constexpr Options kFit{Method::least_squares};
constexpr Options kRobust{Method::robust};

Remark told(const std::vector<EndPose>& cw, const std::vector<EndPose>& ccw, double side_m = kSide_m,
            const WheelFactors& loaded = kNominal, const Options& options = {}) {
  return support::told_by([&] { (void)estimate_factors(cw, ccw, side_m, loaded, options); });
}

TEST(HostileInput, NoRunsAtAll) { EXPECT_THAT(told({}, {}), Tells(EndPoseProblem::no_runs)); }

TEST(HostileInput, OneDirectionAloneCannotSeparateDiametersFromWheelbase) {
  EXPECT_THAT(told(kCw, {}), Tells(EndPoseProblem::one_direction_only, "counter-clockwise"));
  EXPECT_THAT(told({}, kCcw), Tells(EndPoseProblem::one_direction_only, "clockwise"));
}

TEST(HostileInput, ARunThatIsNotFiniteIsNamed) {
  EXPECT_THAT(told(kCw, {{0.3, -0.2, 0.1}, {kNaN, 0, 0}}),
              Tells(EndPoseProblem::not_finite, "counter-clockwise run 2"));
}

TEST(HostileInput, SideOfTheSquareMustBeALength) {
  for (const double side_m : {0.0, -3.0, kNaN, double{INFINITY}})
    EXPECT_THAT(told(kCw, kCcw, side_m), Tells(EndPoseProblem::bad_side, to_text(side_m)));
}

TEST(HostileInput, LoadedFactorsMustBePositive) {
  for (const double b_m : {0.0, -0.29, kNaN, double{INFINITY}}) {
    EXPECT_THAT(told(kCw, kCcw, kSide_m, {1, 1, b_m}), Tells(EndPoseProblem::bad_wheelbase, to_text(b_m)));
  }
  for (const WheelFactors& loaded :
       {WheelFactors{0, 1, 0.29}, WheelFactors{1, -1, 0.29}, WheelFactors{kNaN, 1, 0.29}}) {
    EXPECT_THAT(told(kCw, kCcw, kSide_m, loaded),
                Tells(EndPoseProblem::bad_wheel_factors, to_text(loaded.c_r), to_text(loaded.c_l)));
  }
}

TEST(HostileInput, ExtendedMethodAsksForHeadings) {
  const std::vector<EndPose> positions{{0.31, -0.26, kNaN}};
  EXPECT_THAT(told(kCw, positions, kSide_m, kNominal, kExtended),
              Tells(EndPoseProblem::no_headings, "counter-clockwise"));
  EXPECT_THAT(told(positions, positions, kSide_m, kNominal, kExtended),
              Tells(EndPoseProblem::no_headings, "clockwise"));
}

TEST(HostileInput, ExtendedMethodNamesTheRunThatLacksItsHeading) {
  std::vector<EndPose> some(kCw.begin(), kCw.end());
  some.push_back({0.31, -0.26, kNaN});
  EXPECT_THAT(told(some, kCcw, kSide_m, kNominal, kExtended),
              Tells(EndPoseProblem::no_heading, "clockwise", "2"));
}

TEST(HostileInput, PositionsAreEnoughForTheOtherMethods) {
  const std::vector<EndPose> cw{{-0.2, -0.26, kNaN}, {-0.25, -0.24, kNaN}},
      ccw{{0.31, -0.26, kNaN}, {0.28, -0.3, kNaN}};
  for (const Options& options : {Options{}, kFit, kRobust}) {
    const Estimate e = estimate_factors(cw, ccw, kSide_m, kNominal, options);
    EXPECT_TRUE(std::isfinite(e.factors.c_r) && std::isfinite(e.factors.c_l) && std::isfinite(e.factors.b_m));
    EXPECT_GT(e.se.E_d, 0);
    EXPECT_GT(e.se.b_m, 0);
  }
}

TEST(HostileInput, ASquareTooSmallToSayAnythingIsNoRobotEither) {
  // The squares of what a square of this side changes are below the smallest double: nothing is left to divide by.
  EXPECT_THAT(told(kCw, kCcw, 1e-200, kNominal, kFit), Tells(EndPoseProblem::no_ratios_fit));
}

TEST(HostileInput, MillimetresTakenForMetresAreNoRobot) {
  const std::vector<EndPose> cw{{-223, -260, 8.7}}, ccw{{314, -256, 10}};  // and degrees for radians
  for (const auto& [options, problem] : {std::pair{Options{}, EndPoseProblem::implausible_ratios},
                                         {kExtended, EndPoseProblem::heading_beyond_half_a_turn},
                                         {kFit, EndPoseProblem::no_ratios_fit},
                                         {kRobust, EndPoseProblem::no_ratios_fit}})
    EXPECT_THAT(told(cw, ccw, kSide_m, kNominal, options), Tells(problem)) << name_of(options.method);
}

TEST(HostileInput, AHeadingBeyondHalfATurnIsNamed) {
  EXPECT_THAT(told({{0, 0, 0.03}, {0, 0, 6.25}}, kCcw, kSide_m, kNominal, kExtended),
              Tells(EndPoseProblem::heading_beyond_half_a_turn, "clockwise", "2", "6.25"));
}

TEST(HostileInput, AnyFiniteEndPosesGiveAPlausibleRobotOrSayWhatIsWrong) {
  constexpr unsigned kSeed = 7;
  std::printf("seed %u\n", kSeed);
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    const double size = std::pow(10, uniform(random, -12, 6));
    const auto value = [&] { return size * uniform(random, -1, 1); };
    const std::vector<EndPose> cw{{value(), value(), value()}}, ccw{{value(), value(), value()}};
    for (const Options& options : {Options{}, kExtended, kFit, kRobust}) {
      try {
        const Estimate e = estimate_factors(cw, ccw, kSide_m, kNominal, options);
        EXPECT_TRUE(e.factors.c_r > 0 && e.factors.c_l > 0 && e.factors.b_m > 0);
        EXPECT_TRUE(e.E_d > 0.5 && e.E_d < 2 && e.E_b > 0.5 && e.E_b < 2);
      } catch (const Error& error) {
        EXPECT_THAT(error.remark(), testing::AnyOf(Tells(EndPoseProblem::heading_beyond_half_a_turn),
                                                   Tells(EndPoseProblem::no_ratios_fit),
                                                   Tells(EndPoseProblem::implausible_ratios)));
      }
    }
  }
}

}  // namespace
}  // namespace astro::calibration
