#include "host/calibration/preparation/wheel_way.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace astro::calibration {
namespace {

using testing::ElementsAreArray;

auto is(const std::vector<double>& way_m) { return testing::Pointwise(testing::DoubleNear(1e-12), way_m); }

constexpr double kWheelbase_m = 0.2;

/// With a sample every `step_m` of the wheels' way, but in stands.
struct Drive {
  PreparedRun run;
  explicit Drive(Motion first = Motion::line) {
    run.motion = {first};
    run.path_m = {0};
  }
  Drive& go(Motion motion, int samples, double step_m) {
    for (int i = 0; i < samples; ++i) {
      run.motion.push_back(motion);
      run.path_m.push_back(run.path_m.back() + step_m);
    }
    return *this;
  }
  std::vector<double> knots() const { return way_of_knots(run, kWheelbase_m); }
};

TEST(WayOfKnots, IsThatOfTheWheelsOnLinesAndArcs) {
  const Drive drive = Drive().go(Motion::line, 50, 0.01).go(Motion::arc, 50, 0.013);
  EXPECT_THAT(drive.knots(), ElementsAreArray(drive.run.path_m));
}

TEST(WayOfKnots, OfASpinOffersTheMiddleAndWhereTheRobotHasDrivenOn) {
  const Drive drive = Drive()
                          .go(Motion::line, 1, 1.0)
                          .go(Motion::spin, 4, 0.03)
                          .go(Motion::rest, 2, 0)
                          .go(Motion::line, 4, 0.004);
  // From 1 m to 1.12 m the spin; its middle at 1.06 m.
  const std::vector<double> knots = drive.knots();
  EXPECT_THAT(knots, is({0, 1, 1, 1.06, 1.06, 1.06, 1.06, 1.06, 1.06, 1.06, 1.132, 1.136}));
}

TEST(WayOfKnots, OfASpinThatLastsHoldsTheFirstAndTheLastHalfWheelbaseAlone) {
  const Drive drive = Drive().go(Motion::line, 1, 1.0).go(Motion::spin, 40, 0.03).go(Motion::line, 2, 0.02);
  const std::vector<double> knots = drive.knots();
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double way_m = drive.run.path_m[i];
    const bool held = (way_m > 1.001 && way_m < 1.1) || (way_m > 2.1 && way_m < 2.21);
    EXPECT_EQ(knots[i] != way_m, held) << way_m;
  }
}

TEST(WayOfKnots, NeverGoesBackAndEndsWithTheWheels) {
  const Drive drive = Drive(Motion::rest)
                          .go(Motion::spin, 7, 0.02)
                          .go(Motion::line, 1, 0.003)  // not far enough to let go
                          .go(Motion::spin, 9, 0.02)
                          .go(Motion::rest, 3, 0)
                          .go(Motion::arc, 5, 0.02);
  const std::vector<double> knots = drive.knots();
  EXPECT_TRUE(std::is_sorted(knots.begin(), knots.end()));
  EXPECT_EQ(knots.size(), drive.run.path_m.size());
  EXPECT_EQ(knots.back(), drive.run.path_m.back());
}

TEST(WayOfKnots, OfARobotThatNeverDroveOnEndsInTheMiddleOfItsSpin) {
  const Drive drive = Drive(Motion::rest).go(Motion::spin, 4, 0.02).go(Motion::rest, 2, 0);
  EXPECT_THAT(drive.knots(), is({0, 0, 0.04, 0.04, 0.04, 0.04, 0.04}));
}

}  // namespace
}  // namespace astro::calibration
