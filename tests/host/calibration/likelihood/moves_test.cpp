#include "host/calibration/likelihood/moves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/preparation/preparation.hpp"
#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

struct Drive {
  std::vector<Trajectory> trajectories{simulation::study::synthetic_drive(
      simulation::study::square_course(1, Sense::cw), astro_drive(), "run", kSeed)};
  PreparedRuns prepared = prepare(trajectories, astro_drive().loaded, true, Density::all);
  const PreparedRun& run = prepared.runs.front();
  Unknowns unknowns = Unknowns::Zero();
  NoiseModel noise = astro_drive().noise;

  Drive() {
    const WheelFactors& actual = astro_drive().actual;
    unknowns << actual.c_r, actual.c_l, actual.b_m, 0.02, 0.03, -0.02, 0.4, 0.0001, run.truth.front().x_m,
        run.truth.front().y_m, run.truth.front().theta_rad - 0.4, 0.002;
  }
};

/// What two passes of the filter say, but for rounding: sums of a thousand terms.
void expect_the_same(const InnovationSums& a, const InnovationSums& b) {
  EXPECT_NEAR(a.cost, b.cost, 1e-9 * std::abs(b.cost));
  EXPECT_NEAR(a.chi_square, b.chi_square, 1e-9 * b.chi_square);
  EXPECT_EQ(a.degrees_of_freedom, b.degrees_of_freedom);
  for (int i = 0; i < kUnknowns; ++i) {
    const double size = std::sqrt(b.information(i, i));
    EXPECT_NEAR(a.gradient[i], b.gradient[i], 1e-8 * size * std::sqrt(b.chi_square)) << i;
    for (int k = 0; k < kUnknowns; ++k)
      EXPECT_NEAR(a.information(i, k), b.information(i, k), 1e-9 * size * std::sqrt(b.information(k, k)))
          << i << ' ' << k;
  }
  for (std::size_t motion = 0; motion < a.motion.size(); ++motion) {
    EXPECT_EQ(a.motion[motion].samples, b.motion[motion].samples);
    EXPECT_NEAR(a.motion[motion].sum_xy_m2, b.motion[motion].sum_xy_m2, 1e-9 * b.motion[motion].sum_xy_m2);
  }
}

TEST(Moves, SayInLongLegsWhatTheySayInShortOnes) {
  const Drive drive;
  const Moves dense(drive.run, drive.unknowns);
  for (const double spacing_m : {0.03, 0.3, 1.0})
    for (const double first_m : {0.0, spacing_m / 4}) {
      const SampleSelection samples{spacing_m, first_m};
      const auto by = [&](const Moves& moves) {
        return innovations(moves, drive.noise, RobustMode::none, samples);
      };
      const Moves long_legs(drive.run, drive.unknowns, kUsualKappa0, {samples});
      EXPECT_LT(long_legs.legs().size(), dense.legs().size() / 2);
      expect_the_same(by(long_legs), by(dense));
      expect_the_same(by(dense.joined(samples)), by(dense));
    }
}

TEST(Moves, AreSharedByPassesThatBeginAtDifferentSamples) {
  const Drive drive;
  const SampleSelection one{0.4, 0}, other{0.4, 0.1};
  const Moves both(drive.run, drive.unknowns, kUsualKappa0, {one, other});
  for (const SampleSelection& samples : {one, other})
    expect_the_same(innovations(both, drive.noise, RobustMode::none, samples),
                    innovations(Moves(drive.run, drive.unknowns), drive.noise, RobustMode::none, samples));
}

TEST(Moves, ThatAreChangedAreThoseOfTheOtherUnknowns) {
  const Drive drive;
  Unknowns other = drive.unknowns;
  other[kB] *= 1.01;
  other[kClockOffset] += 0.01;
  Moves moves(drive.run, drive.unknowns);
  moves.change(other);
  const InnovationSums changed = innovations(moves, drive.noise),
                       anew = innovations(Moves(drive.run, other), drive.noise);
  EXPECT_EQ(changed.cost, anew.cost);
  EXPECT_EQ(changed.gradient, anew.gradient);
}

}  // namespace
}  // namespace astro::calibration
