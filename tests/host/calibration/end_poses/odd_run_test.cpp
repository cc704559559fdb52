#include "host/calibration/end_poses/odd_run.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace astro::calibration {
namespace {

constexpr double kSide_m = 3;
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
const std::vector<EndPose> kRuns{{0.31, -0.26, 0.17},
                                 {0.30, -0.25, 0.18},
                                 {0.32, -0.27, 0.165},
                                 {0.305, -0.255, 0.172},
                                 {0.298, -0.262, 0.169}};

TEST(MistypedRun, IsFoundWhereverItStandsAndWhicheverWayItsDecimalPointMoved) {
  for (std::size_t i = 0; i < kRuns.size(); ++i)
    for (const double shift : {1e-3, 0.1, 10.0, 1e3})
      for (double EndPose::*value : {&EndPose::x_m, &EndPose::y_m, &EndPose::theta_rad}) {
        std::vector<EndPose> runs = kRuns;
        runs[i].*value *= shift;
        const auto odd = mistyped_run(runs, kSide_m);
        ASSERT_TRUE(odd) << "run " << i << " times " << shift;
        EXPECT_EQ(odd->index, i);
        EXPECT_EQ(odd->value, runs[i].*value);
      }
}

TEST(MistypedRun, IsToldWithItsNumberAndThatOfTheOthers) {
  std::vector<EndPose> runs = kRuns;
  runs[2].x_m = 3.2;
  runs[2].theta_rad = kNotMeasured;
  EXPECT_EQ(described(*mistyped_run(runs, kSide_m)),
            "x = 3.2 m, and 0.305 m in the others, as if its decimal point were misplaced");
}

TEST(MistypedRun, IsNoneAmongRunsThatOnlySlipped) {
  EXPECT_FALSE(mistyped_run(kRuns, kSide_m));
  std::vector<EndPose> slipped = kRuns;
  slipped[4] = {0.55, -0.1, 0.25};  // it bumped into something: far, and no decimal point explains it
  EXPECT_FALSE(mistyped_run(slipped, kSide_m));
}

TEST(MistypedRun, NeedsThreeRuns) {
  EXPECT_FALSE(mistyped_run(std::vector<EndPose>{{0.3, 0, 0}, {3, 0, 0}}, kSide_m));
  EXPECT_FALSE(mistyped_run({}, kSide_m));
}

// Scatter of 1 % of the side about any systematic error up to a tenth of the side, and none at all.
TEST(MistypedRun, IsHardlyEverFoundAmongHonestRuns) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> scatter(0, 0.01 * kSide_m), turn(0, 0.01);
  std::uniform_real_distribution<double> systematic(-0.1 * kSide_m, 0.1 * kSide_m);
  int found = 0;
  constexpr int kTrials = 20'000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const EndPose centre{systematic(random), trial % 2 == 0 ? 0 : systematic(random), 0};
    std::vector<EndPose> runs;
    for (int i = 0; i < 5; ++i)
      runs.push_back({centre.x_m + scatter(random), centre.y_m + scatter(random), turn(random)});
    found += mistyped_run(runs, kSide_m) ? 1 : 0;
  }
  std::printf("%d of %d honest experiments of five runs were doubted\n", found, kTrials);
  EXPECT_LE(found, kTrials / 500);
}

}  // namespace
}  // namespace astro::calibration
