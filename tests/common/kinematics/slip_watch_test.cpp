#include "common/kinematics/slip_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/common/kinematics/gyro_drive.hpp"
#include "tests/support/base/thorough.hpp"

namespace astro {
namespace {

using namespace tests;

/// A robot with filter and watch.
class Watched {
 public:
  Watched(const Gyro& gyro, std::uint64_t seed) : drive_(gyro, seed) {
    const ParameterSet set = ParameterSet::defaults();
    const HeadingFilter::Configuration configuration(set, make_geometry(set));
    filter_.configure(configuration);
    watch_.configure(configuration);
  }
  bool advance(const Motion& motion, double kick_rad = 0) { return take(drive_.advance(motion, kick_rad)); }
  bool take(const HeadingStep& step) {
    filter_.advance(step, !watch_.slipping());
    if (filter_.knows_bias()) return watch_.advance(step, filter_);
    watch_.reset();
    return false;
  }
  const HeadingFilter& filter() const { return filter_; }

 private:
  GyroDrive drive_;
  HeadingFilter filter_;
  SlipWatch watch_;
};

struct Found {
  int slips = 0, told = 0;
  double latest_s = 0, mean_s = 0;  // from the beginning of the slip
};

/// Slips of one size on straight lines at 0.3 m/s, a new robot each time.
Found found(double degrees, int steps, int times) {
  Found sum;
  std::mt19937_64 random(5);
  for (int k = 0; k < times; ++k) {
    Watched robot({}, random());
    for (int i = 0; i < 300; ++i) robot.advance({});
    const int line = 200 + static_cast<int>(random() % 500);
    for (int i = 0; i < line; ++i) EXPECT_FALSE(robot.advance({0.3, 0}));
    ++sum.slips;
    for (int i = 0; i < steps + SlipWatch::kWindow; ++i) {
      if (!robot.advance({0.3, 0}, i < steps ? degrees * kDegree / steps : 0)) continue;
      ++sum.told;
      sum.latest_s = std::max(sum.latest_s, (i + 1) * 0.01);
      sum.mean_s += (i + 1) * 0.01;
    }
  }
  sum.mean_s /= std::max(sum.told, 1);
  return sum;
}

TEST(SlipWatch, TellsEachSlipOfTwoDegreesWithin150Milliseconds) {
  for (const double degrees : {-2.0, 2.0, 5.0, 20.0}) {
    for (const int steps : {5, 30}) {
      const Found got = found(degrees, steps, support::how_often(100, 400));
      std::printf("  %5.1f degrees in %.2f s: told %d of %d, after %.3f s, at the latest %.3f s\n", degrees,
                  steps / 100.0, got.told, got.slips, got.mean_s, got.latest_s);
      EXPECT_EQ(got.told, got.slips) << "once each";
      EXPECT_LE(got.latest_s, 0.15);
    }
  }
}

TEST(SlipWatch, TellsNineteenOfTwentySlipsOfOneDegree) {
  for (const int steps : {5, 30}) {
    const Found got = found(1.0, steps, support::how_often(300, 1000));
    std::printf("  one degree in %.2f s: told %d of %d, after %.3f s, at the latest %.3f s\n", steps / 100.0,
                got.told, got.slips, got.mean_s, got.latest_s);
    EXPECT_GE(got.told, got.slips * 95 / 100);
    EXPECT_LE(got.told, got.slips) << "once each";
  }
}

TEST(SlipWatch, TakesABiasThatJumpsForASlipNoLongerThanTheFilterNeedsToFindIt) {
  for (const double jump : {-5.0, -3.0, -2.0, -1.7, 1.7, 2.0, 3.0, 5.0}) {
    Watched robot({}, 1);
    for (int i = 0; i < 500; ++i) robot.advance({});
    const Gyro moved{.bias_radps = (1.5 + jump) * kDegree};
    GyroDrive warm(moved, 2);
    for (int i = 0; i < 1200; ++i) robot.take(warm.advance({}));
    ASSERT_TRUE(robot.filter().knows_bias()) << jump;
    const double before = correction_rad(robot.filter());
    for (int i = 0; i < 1000; ++i) EXPECT_FALSE(robot.take(warm.advance({}))) << jump;
    // What lies just beyond the gate is won back slowly: a twentieth of a degree a second may be left.
    EXPECT_NEAR(correction_rad(robot.filter()), before, (std::abs(jump) < 2 ? 1.0 : 0.3) * kDegree) << jump;
    int told = 0;
    for (int i = 0; i < 60; ++i) told += robot.take(warm.advance({}, i < 20 ? kDegree / 4 : 0)) ? 1 : 0;
    EXPECT_EQ(told, 1) << "slips are told again after " << jump;
  }
}

TEST(SlipWatch, IsSilentWithoutSlips) {
  const int hours = support::how_often(2, 200);
  std::mt19937_64 random(3);
  int told = 0;
  for (int hour = 0; hour < hours; ++hour) {
    Gyro gyro;
    gyro.scale_error = hour % 2 == 0 ? 0.0005 : -0.0005;
    Watched robot(gyro, random());
    for (const Motion& motion : lines_and_spins(3600, random)) told += robot.advance(motion) ? 1 : 0;
  }
  std::printf("  false alarms in %d hours: %d\n", hours, told);
  EXPECT_LT(told, std::max(0.1 * hours, 1.0));
}

}  // namespace
}  // namespace astro
