#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "tests/golden/optiodom.hpp"
#include "tests/support/base/places.hpp"

// Whether sets of drives of one real robot differ by what their standard errors say.
namespace astro::golden {
namespace {

using namespace calibration;
using Runs = std::vector<Trajectory>;

/// Limits of chi-square with 4 degrees of freedom.
constexpr double kOneInTwenty = 9.488, kOneInAHundred = 13.277;

class OptiodomStandardErrors : public testing::Test {
 protected:
  void SetUp() override {
    if (optiodom_folder().empty())
      GTEST_SKIP() << "not at hand: " << support::shared_data() / "sousa_optiodom";
  }

  static Runs squares(const char* dataset) {
    Runs runs;
    for (int run = 1; run <= 6; ++run) runs.push_back(raw_optiodom_run(dataset, run));
    return runs;
  }
  static Runs first_squares() { return squares("231220200029"); }
  static Runs second_squares() { return squares("231220200040"); }
  static Runs circles() {
    Runs runs;
    for (int run = 1; run <= 6; ++run) runs.push_back(circular_optiodom_run("231220200121", run));
    return runs;
  }
};

Runs together(Runs runs, const Runs& more) {
  runs.insert(runs.end(), more.begin(), more.end());
  return runs;
}

MlEstimate estimate_of(const Runs& runs) { return estimate_ml(runs, {1, 1, kOptiodomWheelbase_m}); }

/// How far two estimates are apart.
struct Apart {
  std::array<double, 4> z{};  // E_d, b / S, S, e in standard errors
  double chi_square = 0;      // of 4
};

Apart apart(const MlEstimate& a, const MlEstimate& b, bool by_noise_alone = false) {
  const WheelFactors &f = a.factors, &g = b.factors;
  const double S = a.scale(), b_m = f.b_m / S;
  const Eigen::Vector4d difference(f.c_r - g.c_r, f.c_l - g.c_l, f.b_m - g.b_m, f.e - g.e);
  const auto claimed = [&](const MlEstimate& of) -> FactorCovariance {
    return of.covariance / (by_noise_alone ? of.widening : 1);
  };
  const FactorCovariance covariance = claimed(a) + claimed(b);
  const std::array<Eigen::Vector4d, 4> directions{Eigen::Vector4d(1 / f.c_l, -f.c_r / (f.c_l * f.c_l), 0, 0),
                                                  Eigen::Vector4d(-b_m / S / 2, -b_m / S / 2, 1 / S, 0),
                                                  Eigen::Vector4d(0.5, 0.5, 0, 0),
                                                  Eigen::Vector4d(0, 0, 0, 1)};
  Apart out;
  for (std::size_t i = 0; i < directions.size(); ++i)
    out.z[i] = directions[i].dot(difference) / std::sqrt(directions[i].dot(covariance * directions[i]));
  out.chi_square = difference.dot(covariance.ldlt().solve(difference));
  return out;
}

void print(const char* what, const Apart& found) {
  std::printf("%-38s z of E_d %5.2f, b/S %5.2f, S %5.2f, e %5.2f; chi-square %5.2f of 4\n", what, found.z[0],
              found.z[1], found.z[2], found.z[3], found.chi_square);
}

Apart compared(const char* what, const MlEstimate& a, const MlEstimate& b) {
  const Apart found = apart(a, b);
  print(what, found);
  print("  by the noise alone", apart(a, b, true));
  return found;
}

TEST_F(OptiodomStandardErrors, HoldBetweenSetsOfTheSameKind) {
  const MlEstimate first = estimate_of(first_squares()), second = estimate_of(second_squares());
  EXPECT_LT(compared("squares and squares", first, second).chi_square, kOneInTwenty);
}

TEST_F(OptiodomStandardErrors, HoldAcrossSquaresAndCircles) {
  const Runs first = first_squares(), second = second_squares();
  const MlEstimate of_circles = estimate_of(circles());
  const Apart by_first = compared("first squares and circles", estimate_of(first), of_circles);
  const Apart by_second = compared("second squares and circles", estimate_of(second), of_circles);
  const Apart by_both =
      compared("both squares and circles", estimate_of(together(first, second)), of_circles);
  for (const Apart& found : {by_first, by_second, by_both}) {
    EXPECT_LT(found.chi_square, kOneInAHundred);
    for (const double z : found.z) EXPECT_LT(std::abs(z), 3) << "S is the furthest";
  }
}

/// Half of a set is two runs one way round and one the other: without two numbers of 0, 1, 2 and 3, 4, 5.
Runs half(const Runs& runs, std::size_t of_cw, std::size_t of_ccw, bool other) {
  Runs part;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool in_first = i == of_cw || (i >= 3 && i != of_ccw);
    if (in_first != other) part.push_back(runs[i]);
  }
  return part;
}

TEST_F(OptiodomStandardErrors, HoldBetweenHalvesOfSets) {
  std::vector<std::vector<MlEstimate>> halves;
  for (const Runs& runs : {first_squares(), second_squares(), circles()}) {
    halves.emplace_back();
    for (std::size_t split = 0; split < 3; ++split)
      for (const bool other : {false, true})
        halves.back().push_back(estimate_of(half(runs, split, 3 + split, other)));
  }
  struct Mean {
    double claimed = 0, by_noise_alone = 0;
    int pairs = 0;
  } within, across;
  double worst = 0;
  const auto compare = [&](Mean& mean, const MlEstimate& a, const MlEstimate& b) {
    const double chi_square = apart(a, b).chi_square;
    worst = std::max(worst, chi_square);
    mean.claimed += chi_square;
    mean.by_noise_alone += apart(a, b, true).chi_square;
    ++mean.pairs;
  };
  for (const std::vector<MlEstimate>& of_set : halves)
    for (std::size_t split = 0; split < of_set.size(); split += 2)
      compare(within, of_set[split], of_set[split + 1]);
  for (const std::vector<MlEstimate>* squares : {&halves[0], &halves[1]})
    for (const MlEstimate& a : *squares)
      for (const MlEstimate& b : halves[2]) compare(across, a, b);
  for (Mean* mean : {&within, &across}) {
    mean->claimed /= mean->pairs;
    mean->by_noise_alone /= mean->pairs;
  }
  std::printf("chi-square of 4: halves of a set %.2f, squares and circles %.2f, largest %.2f\n",
              within.claimed, across.claimed, worst);
  std::printf("  by the noise alone %.2f and %.2f\n", within.by_noise_alone, across.by_noise_alone);
  // Of nine independent ones the mean has a standard deviation of sqrt(8) / 3; the pairs across have halves in common, so less is
  // known of their mean.
  EXPECT_LT(within.claimed, 4 + 3 * std::sqrt(8.0) / 3);
  EXPECT_LT(across.claimed, 4 + 3 * std::sqrt(8.0) / 3);
  EXPECT_LT(worst, kOneInAHundred);
}

TEST_F(OptiodomStandardErrors, CountErrorsThatReturnAtTheSamePlacesOfTheSquare) {
  const MlEstimate first = estimate_of(first_squares());
  const MlEstimate both = estimate_of(together(first_squares(), second_squares()));
  std::printf("widening of the variances: %.2f of six squares, %.2f of twelve; dispersion of runs %.2f\n",
              first.widening, both.widening, both.dispersion);
  // Between runs there is no sign of them: the drives of the same square agree better than their noise says.
  EXPECT_EQ(both.dispersion, 1);
  EXPECT_GT(first.widening, 1.1);
  // The more runs, the more of what is left is what they have in common.
  EXPECT_GT(both.widening, 1.4 * first.widening);
  EXPECT_LT(both.se.E_d, 1.5 * first.se.E_d);
}

}  // namespace
}  // namespace astro::golden
