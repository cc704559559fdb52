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

using Spacings = std::vector<std::vector<Eigen::Vector3d>>;

/// Innovations at twice the spacing again and again, of mean squares 1, and of `far` where errors come back or go on.
Spacings spacings(std::uint64_t seed, double far, int count = 9000, int components = 3) {
  std::mt19937_64 random(seed);
  Spacings all;
  for (int spacing = 0; count > 0; ++spacing, count /= 2) {
    std::normal_distribution<double> normal(0, spacing < 4 ? 1 : std::sqrt(far));
    auto& innovations = all.emplace_back();
    for (int k = 0; k < count; ++k) {
      Eigen::Vector3d e = Eigen::Vector3d::Zero();
      for (int i = 0; i < components; ++i) e[i] = normal(random);
      innovations.push_back(e);
    }
  }
  return all;
}

TEST(WhitenessOverPath, HoldsForIndependentInnovations) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    EXPECT_TRUE(hold_over_path(spacings(seed, 1), kFitted)) << "seed " << seed;
    EXPECT_TRUE(hold_over_path(spacings(seed, 1, 9000, 2), kFitted)) << "positions, seed " << seed;
  }
}

TEST(WhitenessOverPath, ErrorsThatComeBackAreNoticed) {
  EXPECT_FALSE(hold_over_path(spacings(1, 0.5), kFitted));
}

TEST(WhitenessOverPath, ErrorsThatGoOnAreNoticed) { EXPECT_FALSE(hold_over_path(spacings(1, 1.5), kFitted)); }

TEST(WhitenessOverPath, WhatHardlyMattersIsNot) {
  EXPECT_TRUE(hold_over_path(spacings(1, 0.95, 1'000'000), kFitted));
}

TEST(WhitenessOverPath, OneDirectionAloneIsEnough) {
  Spacings all = spacings(1, 1);
  const Spacings other = spacings(2, 0.4);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < all[i].size(); ++k) all[i][k][1] = other[i][k][1];
  EXPECT_FALSE(hold_over_path(all, kFitted));
}

TEST(WhitenessOverPath, HowLargeTheInnovationsAreDoesNotMatter) {
  Spacings all = spacings(3, 1);
  for (auto& spacing : all)
    for (Eigen::Vector3d& e : spacing) e *= 1.5;
  EXPECT_TRUE(hold_over_path(all, kFitted));
}

TEST(WhitenessOverPath, WhatTheFitTookIsNotMissed) {
  // Of 1000 squares 500 are left, because as many unknowns were fitted.
  Spacings all = spacings(1, 1, 2000, 1);
  for (Eigen::Vector3d& e : all[1]) e *= std::sqrt(0.5);
  EXPECT_TRUE(hold_over_path(std::span(all).first(2), 500));
  EXPECT_FALSE(hold_over_path(std::span(all).first(2), 10));
}

TEST(WhitenessOverPath, OfTooFewInnovationsNothingIsClaimed) {
  EXPECT_TRUE(hold_over_path(spacings(1, 0.5, 200), kFitted));
  EXPECT_TRUE(hold_over_path({}, kFitted));
}

}  // namespace
}  // namespace astro::calibration
