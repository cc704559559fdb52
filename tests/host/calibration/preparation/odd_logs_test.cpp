#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "host/calibration/judgement/remarks.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/preparation/preparation_problem.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/thorough.hpp"

// Logs of wheels with gaps, at low rates, or of encoders with few counts give factors with the error that is due.
namespace astro::calibration {
namespace {

using simulation::study::derived_seed;
using simulation::study::DriveModel;

/// How far the factors of several sets are from the truth, in standard errors.
struct Misses {
  double largest = 0, squares = 0;
  int count = 0;

  void take(const MlEstimate& found, const WheelFactors& actual) {
    const std::array errors{(found.E_d() - actual.c_r / actual.c_l) / found.se.E_d,
                            (found.scale() - (actual.c_r + actual.c_l) / 2) / found.se.scale,
                            (found.factors.b_m - actual.b_m) / found.se.b_m};
    for (const double error : errors) {
      largest = std::max(largest, std::abs(error));
      squares += error * error;
      ++count;
    }
  }
  double mean_square() const { return squares / count; }
};

// Of 48 normal errors one is beyond this in a thousand of such tests.
constexpr double kMost = 4.2;

/// The mean square is 1.3 for whole logs (of four squares), and below this in 999 of 1000 tests: the quantile of chi-square by
/// Wilson and Hilferty, Proc. Natl. Acad. Sci. 17 (1931), 1.75 times the mean with 48 degrees of freedom.
double most_mean_square(const Misses& misses) {
  constexpr double kNormal = 3.09;
  const double part = 2.0 / (9 * misses.count);
  return 1.3 * std::pow(1 - part + kNormal * std::sqrt(part), 3);
}

template <class Spoil>
Misses misses_of(const DriveModel& model, Spoil spoil) {
  Misses misses;
  const int sets = support::how_often(4, 16);
  for (int set = 0; set < sets; ++set) {
    std::vector<Trajectory> runs = squares(model, 4, 2, derived_seed(kSeed, static_cast<std::uint64_t>(set)));
    std::mt19937_64 random(derived_seed(kSeed + 1, static_cast<std::uint64_t>(set)));
    for (Trajectory& run : runs) spoil(run, random);
    misses.take(estimate_ml(runs, model.loaded), model.actual);
  }
  std::printf("largest %.2f standard errors, mean square %.2f\n", misses.largest, misses.mean_square());
  return misses;
}

void lose(Trajectory& run, double from_s, double to_s) {
  std::erase_if(run.wheels,
                [&](const WheelSample& sample) { return sample.time_s > from_s && sample.time_s < to_s; });
}

/// Keeps every n-th sample of the wheels.
void keep_every(Trajectory& run, std::size_t n) {
  std::vector<WheelSample> kept;
  for (std::size_t i = 0; i < run.wheels.size(); i += n) kept.push_back(run.wheels[i]);
  run.wheels = std::move(kept);
}

TEST(OddLogs, HaveTheErrorOfWholeOnesWithoutAFault) {
  const Misses misses = misses_of(astro_drive(), [](Trajectory&, std::mt19937_64&) {});
  EXPECT_LT(misses.mean_square(), most_mean_square(misses));
}

TEST(OddLogs, GapsOfCountersAreBridged) {
  for (const double length_s : {0.5, 2.0}) {
    const Misses misses = misses_of(astro_drive(), [&](Trajectory& run, std::mt19937_64& random) {
      std::uniform_real_distribution<double> begin_s(run.wheels.front().time_s + 3,
                                                     run.wheels.back().time_s - 6);
      for (int gap = 0; gap < 3; ++gap) {
        const double from_s = begin_s(random);
        lose(run, from_s, from_s + length_s);
      }
    });
    EXPECT_LT(misses.largest, kMost) << length_s;
    EXPECT_LT(misses.mean_square(), most_mean_square(misses)) << length_s;
  }
}

TEST(OddLogs, BridgedGapsAreSaid) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  lose(runs[0], 10, 10.6);
  lose(runs[0], 15, 16);
  const MlEstimate found = estimate_ml(runs, astro_drive().loaded);
  EXPECT_THAT(remarks(found, false),
              testing::Contains(support::Tells(PreparationProblem::odometry_bridged, "run 1", "2",
                                               testing::StartsWith("1."))));
}

TEST(OddLogs, ThatAreTooSeldomToShowTheTurnsAreSaidToBe) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (Trajectory& run : runs) keep_every(run, 100);
  EXPECT_THAT(remarks(estimate_ml(runs, astro_drive().loaded), false),
              testing::Contains(support::Tells(PreparationProblem::odometry_seldom, "run 1", "1")));
}

TEST(OddLogs, AtLowRatesAreUsedWhereTheWheelsAreKnown) {
  const double period_s =
      squares(astro_drive(), 1)[0].wheels[1].time_s - squares(astro_drive(), 1)[0].wheels[0].time_s;
  for (const double slow_s : {0.2, 0.5}) {
    const auto n = static_cast<std::size_t>(std::lround(slow_s / period_s));
    const Misses misses =
        misses_of(astro_drive(), [&](Trajectory& run, std::mt19937_64&) { keep_every(run, n); });
    EXPECT_LT(misses.largest, kMost) << slow_s;
    EXPECT_LT(misses.mean_square(), most_mean_square(misses)) << slow_s;
  }
}

// On a turn the way between two samples a second apart is not known, only where the robot heads after it.
TEST(OddLogs, OfOneHertzAndLessHaveTheErrorThatIsDue) {
  const double period_s =
      squares(astro_drive(), 1)[0].wheels[1].time_s - squares(astro_drive(), 1)[0].wheels[0].time_s;
  for (const double slow_s : {0.7, 1.0, 1.5})
    for (const std::size_t one_of : {1U, 6U}) {  // truth at 60 Hz and at 10 Hz
      const auto n = static_cast<std::size_t>(std::lround(slow_s / period_s));
      const Misses misses = misses_of(astro_drive(), [&](Trajectory& run, std::mt19937_64&) {
        keep_every(run, n);
        std::size_t i = 0;
        std::erase_if(run.truth, [&](const BodySample&) { return i++ % one_of != 0; });
      });
      EXPECT_LT(misses.largest, kMost) << slow_s << " s, one pose of " << one_of;
      EXPECT_LT(misses.mean_square(), most_mean_square(misses)) << slow_s << " s, one pose of " << one_of;
    }
}

TEST(OddLogs, OfCoarseEncodersHaveTheErrorThatIsDue) {
  for (const double counts : {12.0, 30.0})
    for (const std::size_t n : {1U, 5U}) {
      DriveModel model = astro_drive();
      model.metres_per_count = std::numbers::pi * 0.066 / counts;
      const Misses misses = misses_of(model, [&](Trajectory& run, std::mt19937_64&) { keep_every(run, n); });
      EXPECT_LT(misses.largest, kMost) << counts << " counts in a turn, one of " << n;
      EXPECT_LT(misses.mean_square(), most_mean_square(misses))
          << counts << " counts in a turn, one of " << n;
    }
}

}  // namespace
}  // namespace astro::calibration
