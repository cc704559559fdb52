#include "host/calibration/end_poses/line_scale.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>

#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "tests/host/calibration/end_poses/slipping_squares.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::calibration {
namespace {

using namespace test;

constexpr double kLine_m = 3;
const WheelFactors kLarger{1.004, 1.002, 0.29};

std::vector<LineEnd> lines(SlippingRobot& robot, int count, const WheelFactors& loaded = kNominal) {
  std::vector<LineEnd> list;
  for (int i = 0; i < count; ++i) {
    const EndPose end = robot.line(kLine_m, loaded, kLarger);
    list.push_back({end.x_m, end.y_m, kLine_m, (loaded.c_r + loaded.c_l) / 2});
  }
  return list;
}

TEST(LineScale, IsExactWithoutNoiseThoughTheLineIsAnArc) {
  const WheelFactors curved{1.02, 0.99, 0.29};  // the end is half a metre to the left
  SlippingRobot exact(1, {0, 0, 0});
  const EndPose end = exact.line(kLine_m, kNominal, curved);
  const auto found = scale_of_lines(std::vector<LineEnd>{{end.x_m, end.y_m, kLine_m, 1}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->scale, 1.005, 1e-9);
}

TEST(LineScale, IsAbsoluteWhateverWasLoaded) {
  SlippingRobot exact(1, {0, 0, 0});
  const auto found = scale_of_lines(lines(exact, 1, {0.98, 0.99, 0.3}));
  EXPECT_NEAR(found->scale, 1.003, 5e-5)
      << "a loaded difference of the wheels bends the mean in the second order";
}

TEST(LineScale, KnowsHowFarItIsOff) {
  constexpr int kExperiments = 2000;
  for (const int count : {1, 3}) {
    SlippingRobot robot(2);
    double sum = 0, se = 0;
    for (int i = 0; i < kExperiments; ++i) {
      const auto found = scale_of_lines(lines(robot, count));
      sum += std::pow((found->scale - 1.003) / found->se, 2) / kExperiments;
      se += found->se / kExperiments;
    }
    std::printf("%d lines of %g m: S to %.3f %%, squared error over claimed variance %.2f\n", count, kLine_m,
                100 * se, sum);
    EXPECT_NEAR(sum, 1, 0.25) << "of 2000 it is known to 0.03; the rest is the error of the claimed scatter";
  }
}

TEST(LineScale, IsMovedByOneWrongLineOfThreeByLessThanTwoStandardErrors) {
  constexpr int kExperiments = 500;
  for (const double factor : {0.1, 10.0, 0.9, 1.02}) {
    SlippingRobot robot(3);
    int far = 0;
    for (int i = 0; i < kExperiments; ++i) {
      std::vector<LineEnd> driven = lines(robot, 3);
      const auto clean = scale_of_lines(driven);
      driven[static_cast<std::size_t>(i) % 3].x_m *= factor;
      const auto spoilt = scale_of_lines(driven);
      far += std::abs(spoilt->scale - clean->scale) > 2 * clean->se ? 1 : 0;
    }
    std::printf("one line of three times %g moves S by more than two standard errors in %d of %d\n", factor,
                far, kExperiments);
    // Where the two right lines differ by three standard deviations themselves, nobody knows which is right.
    EXPECT_LE(far, kExperiments / 50) << factor;
  }
}

TEST(LineScale, IsUnknownWithoutLinesAndRefusesAnotherUnit) {
  EXPECT_FALSE(scale_of_lines({}));
  EXPECT_THAT(support::told_by([] {
                scale_of_lines(std::vector<LineEnd>{{3000, 0, 3, 1}});
              }),
              support::Tells(EndPoseProblem::implausible_scale,
                             testing::AnyOf(testing::StartsWith("999."), testing::StartsWith("1000"))));
}

TEST(LineScale, ALineIsOddBeyondThreePercent) {
  EXPECT_FALSE(is_odd({3.08, 0.1, 3, 1}, 1));
  EXPECT_TRUE(is_odd({3.10, 0, 3, 1}, 1));
  EXPECT_TRUE(is_odd({0.30, 0, 3, 1}, 1));
  EXPECT_FALSE(is_odd({3.10, 0, 3, 1}, 1.03));
}

}  // namespace
}  // namespace astro::calibration
