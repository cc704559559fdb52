#include "host/calibration/end_poses/odd_run.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/host/calibration/end_poses/slipping_squares.hpp"

namespace astro::calibration {
namespace {

using namespace test;

const SquareSetup kSetup{kSide_m, kNominal};

std::vector<SquareEnd> ends_of(const std::vector<EndPose>& errors) {
  std::vector<SquareEnd> ends;
  for (const EndPose& error : errors) ends.push_back({error});
  return ends;
}

std::vector<OddRun> odd_in(const Runs& runs) { return odd_runs(ends_of(runs.cw), ends_of(runs.ccw), kSetup); }

TEST(OddRuns, AreNamedByTheMistakeThatExplainsThem) {
  SlippingRobot robot(1);
  const Runs runs = robot.squares(3);
  const EndPose honest = runs.cw[1];
  const std::vector<std::pair<const char*, EndPose>> mistakes{
      {"the decimal point of x", {10 * honest.x_m, honest.y_m, honest.theta_rad}},
      {"the decimal point of y", {honest.x_m, 100 * honest.y_m, honest.theta_rad}},
      {"the decimal point of the heading", {honest.x_m, honest.y_m, 10 * honest.theta_rad}},
      {"another unit of length", {1000 * honest.x_m, 1000 * honest.y_m, honest.theta_rad}},
      {"the sign of x", {-honest.x_m, honest.y_m, honest.theta_rad}},
      {"the sign of y", {honest.x_m, -honest.y_m, honest.theta_rad}},
      {"the sign of the heading", {honest.x_m, honest.y_m, -honest.theta_rad}},
      {"the signs of x and y", {-honest.x_m, -honest.y_m, honest.theta_rad}},
      {"degrees for radians", {honest.x_m, honest.y_m, honest.theta_rad * 180 / std::numbers::pi}}};
  for (const auto& [name, typed] : mistakes) {
    SCOPED_TRACE(name);
    Runs spoilt = runs;
    spoilt.cw[1] = typed;
    const std::vector<OddRun> odd = odd_in(spoilt);
    ASSERT_EQ(odd.size(), 1U);
    EXPECT_EQ(odd[0].sense, Sense::cw);
    EXPECT_EQ(odd[0].index, 1U);
    ASSERT_TRUE(odd[0].mistake);
    if (std::string_view(name) != "degrees for radians") {
      EXPECT_EQ(odd[0].mistake->name, name);
    }
    EXPECT_NEAR(odd[0].mistake->meant.x_m, honest.x_m, 1e-9);
    EXPECT_NEAR(odd[0].mistake->meant.y_m, honest.y_m, 1e-9);
    // A heading in another unit may come closer with its decimal point moved twice: 57.3 is between 10 and 100.
    EXPECT_NEAR(odd[0].mistake->meant.theta_rad, honest.theta_rad, 0.5 * std::abs(honest.theta_rad));
  }
}

TEST(OddRuns, ExchangedCoordinatesShowWhereXAndYHaveOtherSigns) {
  SlippingRobot robot(1);
  Runs runs = robot.squares(3);
  std::swap(runs.ccw[2].x_m, runs.ccw[2].y_m);  // counter-clockwise x is about -y
  const std::vector<OddRun> odd = odd_in(runs);
  ASSERT_EQ(odd.size(), 1U);
  EXPECT_EQ(odd[0].sense, Sense::ccw);
  ASSERT_TRUE(odd[0].mistake);
  EXPECT_THAT(odd[0].mistake->name, testing::AnyOf("x and y exchanged", "the signs of x and y"));
}

TEST(OddRuns, AnEndIsComparedInTheTapesFrameAndNotAsAnError) {
  SlippingRobot robot(1);
  const Runs runs = robot.squares(2);
  std::vector<SquareEnd> cw, ccw = ends_of(runs.ccw);
  const EndPose odometry{0.05, -0.02, 0.01};
  for (const EndPose& error : runs.cw)
    cw.push_back({{error.x_m + odometry.x_m, error.y_m + odometry.y_m, error.theta_rad + odometry.theta_rad},
                  odometry});
  const double honest_m = cw[0].measured.x_m;
  cw[0].measured.x_m *= 10;
  const std::vector<OddRun> odd = odd_runs(cw, ccw, kSetup);
  ASSERT_FALSE(odd.empty());
  ASSERT_TRUE(odd[0].mistake);
  EXPECT_NEAR(odd[0].mistake->meant.x_m, honest_m, 1e-12);
}

TEST(OddRuns, AreDescribedWithWhatTheOthersLetExpect) {
  const OddRun odd{Sense::cw,
                   0,
                   {-0.022, -0.26, kNotMeasured},
                   {-0.228, -0.23, 0.1},
                   30,
                   Mistake{"the decimal point of x", {-0.22, -0.26, kNotMeasured}}};
  EXPECT_EQ(described(odd),
            "x = -22 mm, y = -260 mm, and about x = -228 mm, y = -230 mm is to be expected; x = -220 mm "
            "would fit (the "
            "decimal point of x)");
}

TEST(OddRuns, ASwappedSignShowsInTheVeryFirstSquare) {
  constexpr int kRobots = 200;
  SlippingRobot robot(2);
  int found = 0;
  for (int i = 0; i < kRobots; ++i) {
    Runs runs = robot.squares(1);
    runs.ccw.clear();
    runs.cw[0].x_m = -runs.cw[0].x_m;
    found += odd_in(runs).empty() ? 0 : 1;
  }
  std::printf("a swapped sign of x shows in %d of %d first squares\n", found, kRobots);
  EXPECT_GE(found, kRobots * 9 / 10);  // where slip left an x near 0, its sign matters little
}

/// How often a mistake in the first clockwise square shows once so many squares of each direction are there.
double share_found(int each, const std::function<void(EndPose&)>& spoil) {
  constexpr int kExperiments = 300;
  SlippingRobot robot(3);
  double found = 0;
  for (int i = 0; i < kExperiments; ++i) {
    Runs runs = robot.squares(each);
    spoil(runs.cw[0]);
    for (const OddRun& odd : odd_in(runs))
      if (odd.sense == Sense::cw && odd.index == 0) found += 1.0 / kExperiments;
  }
  return found;
}

TEST(OddRuns, TenTimesTooMuchInTheFirstSquareShowsAtOnceAndADroppedDigitMostly) {
  const double ten_times = share_found(1, [](EndPose& end) { end.x_m *= 10; });
  std::printf("ten times too much, one square each way: found in %.0f %%\n", 100 * ten_times);
  EXPECT_GE(ten_times, 0.95);
  for (const int each : {1, 3, 5}) {
    const double dropped = share_found(each, [](EndPose& end) { end.x_m *= 0.1; });
    std::printf("a dropped digit, %d squares each way: found in %.0f %%\n", each, 100 * dropped);
    EXPECT_GE(dropped, 0.5) << "what slip may have done as well is not found, and is borne by the fit";
  }
}

TEST(OddRuns, AreHardlyEverFoundAmongHonestOnes) {
  constexpr int kExperiments = 500;
  for (const bool headings : {true, false})
    for (const double slip : {0.1, 1.0, 2.0}) {
      SlippingRobot robot(4, {slip * EndNoise{}.slip_m});
      int asked = 0;
      for (int i = 0; i < kExperiments; ++i) {
        Runs runs = robot.squares(5);
        for (int k = 0; k < 5 && !headings; ++k) runs.cw[k].theta_rad = runs.ccw[k].theta_rad = kNotMeasured;
        asked += odd_in(runs).empty() ? 0 : 1;
      }
      std::printf("%g times the slip, headings %d: %d of %d honest experiments have an odd run\n", slip,
                  headings, asked, kExperiments);
      // Where a robot slips more than expected, the first question about an honest run comes sooner: it costs an Enter.
      EXPECT_LE(asked, kExperiments / (slip > 1 ? 12 : 100));
    }
}

TEST(OddRuns, HaveNoMistakeNamedWhereARobotScattersItsEndsOverTheWholeRoom) {
  constexpr int kExperiments = 500;
  SlippingRobot robot(5, {50 * EndNoise{}.slip_m});  // 0.4 m at the end of a square of 3 m
  int odd = 0, named = 0;
  for (int i = 0; i < kExperiments; ++i) {
    Runs runs = robot.squares(5);
    for (int k = 0; k < 5; ++k) runs.cw[k].theta_rad = runs.ccw[k].theta_rad = kNotMeasured;
    for (const OddRun& one : odd_in(runs)) {
      ++odd;
      named += one.mistake ? 1 : 0;
    }
  }
  std::printf("%d odd runs in %d experiments, %d of them with a mistake\n", odd, kExperiments, named);
  EXPECT_LE(named, kExperiments / 100);
}

TEST(OddRuns, AreMostlyNoneIfAllOfADirectionAreOddInTheSameWay) {
  constexpr int kExperiments = 200;
  SlippingRobot robot(1);
  int asked = 0;
  for (int i = 0; i < kExperiments; ++i) {
    Runs runs = robot.squares(4);
    for (EndPose& end : runs.cw) end.y_m = -end.y_m;  // the person takes the right for the left
    asked += odd_in(runs).empty() ? 0 : 1;
  }
  std::printf("in %d of %d experiments with one axis reversed a run is odd\n", asked, kExperiments);
  // Slip may make two of four look right even so, and then somebody is asked, who finds that an axis was reversed.
  EXPECT_LE(asked, kExperiments * 2 / 5);
}

TEST(OddRuns, AreNoneWhereThereAreNoRunsOrNothingExplainsThem) {
  EXPECT_TRUE(odd_in({}).empty());
  EXPECT_TRUE(odd_in({{{1e9, 1e9, 3}}, {{-1e9, 1e9, 3}}}).size() <= 2);
}

}  // namespace
}  // namespace astro::calibration
