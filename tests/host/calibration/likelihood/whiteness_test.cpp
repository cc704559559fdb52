#include "host/calibration/likelihood/whiteness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace astro::calibration {
namespace {

using Runs = std::vector<std::vector<Eigen::Vector3d>>;

constexpr int kFitted = 31;  // six runs

/// Innovations e_k + after * (sum of all earlier e, fading by `fade` a step): independent for after = 0.
Runs innovations(std::uint64_t seed, double after, double fade, int count = 1500, int components = 3) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Runs runs(6);
  for (auto& run : runs) {
    Eigen::Vector3d memory = Eigen::Vector3d::Zero();
    for (int k = 0; k < count; ++k) {
      Eigen::Vector3d e = Eigen::Vector3d::Zero();
      for (int i = 0; i < components; ++i) e[i] = normal(random);
      run.push_back(e + after * memory);
      memory = fade * memory + e;
    }
  }
  return runs;
}

TEST(Whiteness, IndependentInnovationsAreTakenForThat) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    EXPECT_TRUE(are_independent(innovations(seed, 0, 0), kFitted)) << "seed " << seed;
    EXPECT_TRUE(are_independent(innovations(seed, 0, 0, 1500, 2), kFitted)) << "positions, seed " << seed;
  }
}

TEST(Whiteness, ErrorsThatComeBackAreNoticed) {
  // Each is taken back by a tenth at once, and by less and less over the next ten samples: none of their
  // neighbours tells it, their sums do.
  EXPECT_FALSE(are_independent(innovations(1, -0.1, 0.9), kFitted));
}

TEST(Whiteness, ErrorsThatGoOnAreNoticed) {
  EXPECT_FALSE(are_independent(innovations(1, 0.1, 0.9), kFitted));
}

TEST(Whiteness, OneDirectionAloneIsEnough) {
  Runs runs = innovations(1, 0, 0);
  const Runs other = innovations(2, -0.1, 0.9);
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t k = 0; k < runs[i].size(); ++k) runs[i][k][1] = other[i][k][1];
  EXPECT_FALSE(are_independent(runs, kFitted));
}

TEST(Whiteness, HowLargeTheInnovationsAreDoesNotMatter) {
  Runs runs = innovations(3, 0, 0);
  for (auto& run : runs)
    for (Eigen::Vector3d& e : run) e *= 1.5;
  EXPECT_TRUE(are_independent(runs, kFitted));
}

TEST(Whiteness, OfTooFewInnovationsNothingIsClaimed) {
  EXPECT_TRUE(are_independent(innovations(1, -0.1, 0.9, 30), kFitted));
  EXPECT_TRUE(are_independent({}, kFitted));
}

}  // namespace
}  // namespace astro::calibration
