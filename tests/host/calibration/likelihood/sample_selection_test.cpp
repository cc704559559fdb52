#include "host/calibration/likelihood/sample_selection.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "host/calibration/preparation/preparation.hpp"
#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

std::vector<std::size_t> taken(const SampleSelection& selection, const std::vector<double>& path_m) {
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < path_m.size(); ++i)
    if (selection.takes(path_m, i)) samples.push_back(i);
  return samples;
}

const std::vector<double> kPath_m{0, 0.1, 0.2, 0.31, 0.31, 0.31, 0.4, 0.5, 0.95};

TEST(SampleSelection, TakesAllWithoutASpacing) { EXPECT_EQ(taken({}, kPath_m).size(), kPath_m.size()); }

TEST(SampleSelection, TakesTheFirstSampleBehindEachKnot) {
  EXPECT_EQ(taken({0.3, 0}, kPath_m), (std::vector<std::size_t>{0, 3, 8}));
  EXPECT_EQ(taken({0.3, 0.15}, kPath_m), (std::vector<std::size_t>{2, 7, 8}));
}

TEST(SampleSelection, TakesAtMostOneSampleOfAStand) {
  for (double first_m = 0; first_m < 0.3; first_m += 0.01) {
    int of_stand = 0;
    for (const std::size_t i : taken({0.3, first_m}, kPath_m)) of_stand += i >= 3 && i <= 5 ? 1 : 0;
    EXPECT_LE(of_stand, 1) << first_m;
  }
}

TEST(WayOfTheWheels, GrowsInASpinAndNotInAStandWhoseCountsFlicker) {
  simulation::study::DriveModel model = quiet_drive();
  Trajectory run =
      simulation::study::synthetic_drive(simulation::study::spin_course(3, 2), model, "spin", kSeed);
  for (std::size_t i = 0; i < run.wheels.size(); i += 2) run.wheels[i].left_m += 3e-4;
  const PreparedRun prepared = prepare(std::vector{run}, model.loaded, true, Density::all).runs.front();
  // Each wheel turns the robot by 3 rad about its middle.
  EXPECT_NEAR(prepared.path_m.back(), 3 * model.loaded.b_m / 2, 5e-3);
  std::size_t in_stand = 0;
  while (prepared.truth[in_stand].time_s < 1.9) ++in_stand;
  EXPECT_EQ(prepared.path_m[in_stand], 0);
}

}  // namespace
}  // namespace astro::calibration
