#include "host/lidar/stretch_fit.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "host/lidar/factor_choice.hpp"
#include "tests/host/lidar/synthetic_room.hpp"

namespace astro::lidar {
namespace {

/// Stretches of arcs, of which the scans say what another robot would have driven, and `scatter` besides.
std::vector<Stretch> arcs(std::size_t count, double scatter, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Stretch> all(count);
  for (Stretch& one : all) {
    const double along_m = 0.5, across_m = 0.1 * normal(random);
    one.steps = {{along_m - across_m, along_m + across_m}};
    one.scanner = {predicted(one, nothing_wrong(kLoaded), kLoaded), 1e-4 * Eigen::Matrix3d::Identity(),
                   false};
    for (double* value : {&one.scanner->motion.x_m, &one.scanner->motion.y_m, &one.scanner->motion.theta_rad})
      *value += scatter * normal(random);
  }
  return all;
}

TEST(StretchFit, SaysWhereItsStretchesWereLinearisedEvenIfItDoesNotConverge) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Stretch> stretches = arcs(5, 3, seed);
    const IteratedFit all = iterated_fit(stretches, wide_prior(nothing_wrong(kLoaded), true), kLoaded);
    const std::vector<LinearStretch> there = linearised(stretches, all.at, kLoaded);
    for (std::size_t i = 0; i < there.size(); ++i)
      EXPECT_EQ(there[i].residual, all.stretches[i].residual) << seed;
  }
}

TEST(FactorChoice, OfGainsThatAreNoNumbersIsNone) {
  const std::vector<Stretch> stretches = arcs(200, 0.01, 1);
  std::vector<LinearStretch> linear = linearised(stretches, nothing_wrong(kLoaded), kLoaded);
  for (LinearStretch& one : linear) one.residual.setConstant(std::numeric_limits<double>::quiet_NaN());
  const FactorChoice choice =
      choose_factors(stretches, linear, nothing_wrong(kLoaded), nothing_wrong(kLoaded), false, kLoaded);
  EXPECT_EQ(choice.set.name, "");
  EXPECT_TRUE(can_be_judged(choice));
  EXPECT_FALSE(choice.better());
}

}  // namespace
}  // namespace astro::lidar
