#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>

#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/film/runs/film_truth.hpp"
#include "tests/host/film/recorded_film.hpp"
#include "tests/support/base/thorough.hpp"

/// Drives that a film shows, calibrated from it and from the true poses.
namespace astro::film {
namespace {

namespace fs = std::filesystem;

using support::camera_data;

std::vector<recording::TruthSample> true_poses() {
  std::ifstream file(camera_data() / "truth" / "truth_poses.csv");
  std::string line;
  std::getline(file, line);
  std::vector<recording::TruthSample> poses;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    double time_s = 0, body[3], tag[3];
    cells >> time_s >> body[0] >> body[1] >> body[2] >> tag[0] >> tag[1] >> tag[2];
    poses.push_back({std::llround(1e6 * time_s), tag[0], tag[1], tag[2]});
  }
  return poses;
}

experiment::RunSet with_true_poses(experiment::RunSet set) {
  const std::vector<recording::TruthSample> poses = true_poses();
  for (recording::Run& run : set.runs) {
    run.truth.clear();
    for (const recording::TruthSample& pose : poses)
      if (pose.time_us >= run.odometry.front().time_us && pose.time_us <= run.odometry.back().time_us)
        run.truth.push_back(pose);
    run.info.truth_clock = "robot";
  }
  return set;
}

TEST(FilmCalibration, FindsWhatTheTruePosesFind) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  if (!fs::exists(support::recorded_film())) GTEST_SKIP() << "the film is not beside this checkout";
  experiment::RunSet set = experiment::read_run_set(camera_data() / "runs");
  const experiment::Calibration exact =
      experiment::calibrate(with_true_poses(set), {experiment::MethodChoice::Family::ml, {}});
  const FilmReport report =
      attach_films(set, {{"dev.mp4", film::follow_film(support::recorded_film(), support::stated_figures())}},
                   std::nullopt);
  const experiment::Calibration found =
      experiment::calibrate(set, {experiment::MethodChoice::Family::ml, {}});
  const double ratio = found.E_d() / exact.E_d() - 1;
  const double base = (found.factors.b_m / found.scale()) / (exact.factors.b_m / exact.scale()) - 1;
  const double scale = found.scale() / exact.scale() - 1;
  std::cout << "less that from true poses: E_d " << ratio << ", b/S " << base << ", S " << scale
            << "; readout " << 1e3 * report.readout_s << " +- " << 1e3 * report.readout_sigma_s.value_or(0)
            << " ms\n";
  EXPECT_LE(std::abs(ratio), 5e-4);
  EXPECT_LE(std::abs(base), 2.5e-3);  // two squares only
  EXPECT_LE(std::abs(scale), 1.5e-3);
  EXPECT_LE(std::abs(scale), 2 * found.se.scale);
  ASSERT_TRUE(report.readout_sigma_s);
  EXPECT_NEAR(report.readout_s, 0.020, 3 * *report.readout_sigma_s);

  // The same without a measured distance: E_d and b / S are those, and S is as loaded.
  for (recording::Run& run : set.runs) run.info.truth_scale_sigma = std::numeric_limits<double>::infinity();
  const experiment::Calibration unscaled =
      experiment::calibrate(set, {experiment::MethodChoice::Family::ml, {}});
  EXPECT_NEAR(unscaled.E_d(), found.E_d(), 1e-9);
  EXPECT_NEAR(unscaled.factors.b_m / unscaled.scale(), found.factors.b_m / found.scale(), 1e-9);
  EXPECT_NEAR(unscaled.scale_change(), 1, 1e-12);
  EXPECT_TRUE(std::isnan(unscaled.se.scale));

  // Sheets that were printed too small make all lengths of the film wrong, and say nothing about the wheels.
  for (recording::Run& run : set.runs)
    for (recording::TruthSample& sample : run.truth) sample.x_m *= 0.97, sample.y_m *= 0.97;
  const experiment::Calibration small =
      experiment::calibrate(set, {experiment::MethodChoice::Family::ml, {}});
  EXPECT_NEAR(small.E_d(), found.E_d(), 1e-6);
  EXPECT_NEAR(small.judgement.in_use().path_m, 0.97 * unscaled.judgement.in_use().path_m, 1e-3);
}

}  // namespace
}  // namespace astro::film
