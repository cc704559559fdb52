#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "tests/host/calibration/end_poses/square_runs.hpp"

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

std::string error_for(const std::vector<EndPose>& cw, const std::vector<EndPose>& ccw,
                      double side_m = kSide_m, const WheelFactors& loaded = kNominal,
                      const Options& options = {}) {
  return told(cw, ccw, side_m, loaded, options).sentence;
}

TEST(HostileInput, NoRunsAtAll) {
  EXPECT_THAT(told({}, {}), Tells("there are no runs at all", Help::drive_both_directions));
}

TEST(HostileInput, OneDirectionAloneCannotSeparateDiametersFromWheelbase) {
  const std::string rest =
      " runs, and one direction alone cannot separate the error of the wheel diameters from that of the "
      "wheelbase";
  EXPECT_THAT(told(kCw, {}), Tells("there are no counter-clockwise" + rest, Help::drive_both_directions));
  EXPECT_THAT(told({}, kCcw), Tells("there are no clockwise" + rest, Help::drive_both_directions));
}

TEST(HostileInput, ARunThatIsNotFiniteIsNamed) {
  EXPECT_THAT(
      told(kCw, {{0.3, -0.2, 0.1}, {kNaN, 0, 0}}),
      Tells("counter-clockwise run 2 has an end pose that is not finite", Help::measure_again_or_leave_out));
}

TEST(HostileInput, SideOfTheSquareMustBeALength) {
  EXPECT_EQ(error_for(kCw, kCcw, 0),
            "the side of the square is 0 m, and has to be the length of one leg in metres, such as 3");
  for (const double side_m : {-3.0, kNaN, double{INFINITY}}) {
    EXPECT_EQ(error_for(kCw, kCcw, side_m).find("the side of the square is "), 0U);
  }
}

TEST(HostileInput, LoadedFactorsMustBePositive) {
  for (const double b_m : {0.0, -0.29, kNaN, double{INFINITY}}) {
    const std::string message = error_for(kCw, kCcw, kSide_m, {1, 1, b_m});
    EXPECT_EQ(message.find("the loaded wheelbase is "), 0U);
    EXPECT_NE(message.find("has to be the distance between the wheels in metres, such as 0.29"),
              std::string::npos);
  }
  for (const WheelFactors& loaded :
       {WheelFactors{0, 1, 0.29}, WheelFactors{1, -1, 0.29}, WheelFactors{kNaN, 1, 0.29}}) {
    const std::string message = error_for(kCw, kCcw, kSide_m, loaded);
    EXPECT_EQ(message.find("the loaded wheel factors are c_R = "), 0U);
    EXPECT_NE(message.find("have to be positive ratios, 1 for a nominal wheel"), std::string::npos);
  }
}

TEST(HostileInput, ExtendedMethodAsksForHeadings) {
  const std::vector<EndPose> positions{{0.31, -0.26, kNaN}};
  EXPECT_THAT(
      told(kCw, positions, kSide_m, kNominal, kExtended),
      Tells("the counter-clockwise runs have no heading error, which the extended method calibrates from",
            Help::measure_end_headings));
  EXPECT_EQ(error_for(positions, positions, kSide_m, kNominal, kExtended)
                .find("the clockwise runs have no heading"),
            0U);
}

TEST(HostileInput, ExtendedMethodNamesTheRunThatLacksItsHeading) {
  std::vector<EndPose> some(kCw.begin(), kCw.end());
  some.push_back({0.31, -0.26, kNaN});
  EXPECT_EQ(error_for(some, kCcw, kSide_m, kNominal, kExtended)
                .find("clockwise run " + std::to_string(some.size()) + " has no heading error"),
            0U);
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
  EXPECT_NE(error_for(kCw, kCcw, 1e-200, kNominal, kFit).find("no pair of wheel and wheelbase ratios"),
            std::string::npos);
}

TEST(HostileInput, MillimetresTakenForMetresAreNoRobot) {
  const std::vector<EndPose> cw{{-223, -260, 8.7}}, ccw{{314, -256, 10}};  // and degrees for radians
  for (const Options& options : {Options{}, kExtended, kFit, kRobust}) {
    EXPECT_EQ(told(cw, ccw, kSide_m, kNominal, options).remedy.help,
              options.method == Method::extended ? Help::check_units : Help::check_units_and_directions)
        << name_of(options.method);
  }
}

TEST(HostileInput, AHeadingBeyondHalfATurnIsNamed) {
  EXPECT_THAT(
      told({{0, 0, 0.03}, {0, 0, 6.25}}, kCcw, kSide_m, kNominal, kExtended),
      Tells("clockwise run 2 has a heading error of 6.25 rad, more than half a turn, outside the range "
            "of -180 to 180 degrees",
            Help::check_units));
}

TEST(HostileInput, AnyFiniteEndPosesGiveAPlausibleRobotOrOneSentence) {
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
        EXPECT_THAT(error.remedy().help, testing::AnyOf(Help::check_units, Help::check_units_and_directions));
      }
    }
  }
}

}  // namespace
}  // namespace astro::calibration
