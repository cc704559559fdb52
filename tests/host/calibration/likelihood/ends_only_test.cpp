#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "host/calibration/judgement/remarks.hpp"
#include "host/calibration/likelihood/noise_of_ends.hpp"
#include "host/calibration/preparation/preparation_problem.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/thorough.hpp"

// Drives of which only the poses before and after were measured, with a tape or as a tracker's two rows.
namespace astro::calibration {
namespace {

using simulation::study::DriveModel;

std::vector<Trajectory> drives_with_ends(const DriveModel& model, std::uint64_t seed) {
  std::vector<Trajectory> runs = varied_drives(model, seed);
  for (Trajectory& run : runs) {
    run.truth = {run.truth.front(), run.truth.back()};
    run.ends_only = true;
  }
  return runs;
}

MlEstimate from_ends(const std::vector<Trajectory>& runs, const WheelFactors& loaded) {
  MlOptions options;
  options.clock_known = true;
  options.noise = noise_of_ends(runs, loaded, options);
  return estimate_ml(runs, loaded, options);
}

TEST(EndsOnly, OfArbitraryDrivesGiveAllFactorsWithAnHonestError) {
  const int trials = support::how_often(15, 60);
  const double spread = std::sqrt(6.0 / trials);  // of the mean of chi-squares of 3
  for (const double slip : {0.3, 1.0, 5.0}) {
    DriveModel model = astro_drive();
    model.noise = {slip * 2.645e-6, 0.002, 0.007};
    model.clock_offset_s = 17;  // nobody looks at it
    double chi_square = 0, scatter = 0;
    for (int trial = 0; trial < trials; ++trial) {
      const MlEstimate found =
          from_ends(drives_with_ends(model, kSeed + static_cast<std::uint64_t>(trial)), model.loaded);
      const Eigen::Vector3d off(found.factors.c_r - model.actual.c_r, found.factors.c_l - model.actual.c_l,
                                found.factors.b_m - model.actual.b_m);
      const Eigen::Matrix3d covariance = found.covariance.topLeftCorner<3, 3>();
      chi_square += off.dot(covariance.ldlt().solve(off)) / trials;
      scatter += found.noise.K_m / model.noise.K_m / trials;
    }
    std::printf("slip %.1f of the usual: chi-square %.2f of 3, slip found %.2f of the true\n", slip,
                chi_square, scatter);
    // A slip below the usual is taken for more, because of the prior.
    const double least = 3 - 3.8 * spread;
    EXPECT_LT(chi_square, 3 + 3 * spread);
    EXPECT_GT(chi_square, slip < 1 ? std::min(1.2, least) : least);
  }
}

TEST(EndsOnly, ThatTurnTheOtherWayThanTheWheelsAreToldAsExchangedWheels) {
  DriveModel model = astro_drive();
  model.noise = {2.645e-6, 0.002, 0.007};
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    std::vector<Trajectory> runs = drives_with_ends(model, seed);
    WheelFactors rough = model.loaded;
    rough.b_m *= seed % 2 == 0 ? 0.95 : 1.05;  // as a ruler gives it
    EXPECT_NO_THROW(from_ends(runs, rough)) << seed;
    for (Trajectory& run : runs)
      for (WheelSample& sample : run.wheels) std::swap(sample.left_m, sample.right_m);
    EXPECT_THAT([&] { from_ends(runs, rough); },
                support::ThrowsTelling(PreparationProblem::mirrored_or_clockwise, runs[0].name))
        << seed;
  }
}

TEST(EndsOnly, TooFewToShowTheirHandednessAreStillToldOfExchangedWheels) {
  DriveModel model = astro_drive();
  model.noise = {2.645e-6, 0.002, 0.007};
  std::vector<Trajectory> runs;
  for (const double turn_rad : {7.0, -7.0, 7.0})
    runs.push_back(simulation::study::synthetic_drive(simulation::study::circle_course(1, turn_rad), model,
                                                      "arc", kSeed + runs.size()));
  for (Trajectory& run : runs) {
    run.truth = {run.truth.front(), run.truth.back()};
    run.ends_only = true;
    for (WheelSample& sample : run.wheels) std::swap(sample.left_m, sample.right_m);
  }
  EXPECT_THAT([&] { from_ends(runs, model.loaded); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("exchanged")));
}

TEST(EndsOnly, AreNotSaidToDisagreeWithANoiseThatNobodyGave) {
  DriveModel model = astro_drive();
  model.noise = {2.645e-6, 0.002, 0.007};
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (const Remark& remark : remarks(from_ends(drives_with_ends(model, seed), model.loaded), false))
      EXPECT_NE(remark.kind, Kind(JudgementProblem::estimated_noise_is_wrong)) << remark.sentence;
}

bool has_remark(const MlEstimate& estimate, JudgementProblem problem, const std::string& run = "") {
  return std::ranges::any_of(remarks(estimate, false), [&](const Remark& remark) {
    return remark.kind == Kind(problem) && (run.empty() || remark.values.back() == run);
  });
}

TEST(EndsOnly, OfARobotThatSeemsToSlipFarAreToldWhatThatMayBe) {
  DriveModel model = astro_drive();
  model.noise = {5 * 2.645e-6, 0.002, 0.007};
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const std::vector<Trajectory> honest = drives_with_ends(model, seed);
    EXPECT_FALSE(has_remark(from_ends(honest, model.loaded), JudgementProblem::slips_too_much)) << seed;
  }
  model.noise.K_m = 2.645e-6;
  std::vector<Trajectory> mistyped = drives_with_ends(model, kSeed), others = mistyped;
  mistyped[3].truth[1].x_m += 1;
  EXPECT_TRUE(has_remark(from_ends(mistyped, model.loaded), JudgementProblem::slips_too_much, "run 4"));
  std::swap(others[1].truth, others[3].truth);  // circles of two sizes
  EXPECT_TRUE(has_remark(from_ends(others, model.loaded), JudgementProblem::slips_too_much));
}

TEST(EndsOnly, WithoutANumberForAPlaceAreRefused) {
  const DriveModel model = astro_drive();
  std::vector<Trajectory> runs = drives_with_ends(model, kSeed);
  runs[3].truth[1].x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { from_ends(runs, model.loaded); },
              support::ThrowsTelling(PreparationProblem::too_little_truth, "run 4", "1"));
}

TEST(EndsOnly, NeedTheirPosesAtRestAndNotTheirTimes) {
  const DriveModel model = astro_drive();
  std::vector<Trajectory> runs = drives_with_ends(model, kSeed);
  const MlEstimate found = from_ends(runs, model.loaded);
  for (Trajectory& run : runs) run.truth[1].time_s = 1e6;
  EXPECT_EQ(from_ends(runs, model.loaded).factors.b_m, found.factors.b_m);
}

}  // namespace
}  // namespace astro::calibration
