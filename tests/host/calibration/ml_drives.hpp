#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "host/simulation/study/synthetic_drive.hpp"

/// Drives for the tests of maximum likelihood: a robot like the thesis's, off by known amounts.
namespace astro::calibration {

inline constexpr std::uint64_t kSeed = 20240917;

inline simulation::study::DriveModel astro_drive() {
  constexpr double kEd = 1.00416, kScale = 1.005;
  simulation::study::DriveModel model;
  model.loaded = {1, 1, 0.29};
  model.actual = {kScale * 2 * kEd / (1 + kEd), kScale * 2 / (1 + kEd), 0.29 * 0.99521 * kScale};
  model.noise = {2.645e-6, 5e-4, 2.618e-3};
  model.lever = {0.03, -0.02, 0.4};
  return model;
}

/// So little noise that what is left of an error is the estimator's own.
inline simulation::study::DriveModel quiet_drive() {
  simulation::study::DriveModel model = astro_drive();
  model.noise = {1e-12, 1e-7, 1e-7};
  return model;
}

inline std::vector<Trajectory> squares(const simulation::study::DriveModel& model, int count,
                                       double side_m = 3, std::uint64_t seed = kSeed) {
  std::vector<Trajectory> runs;
  for (int i = 0; i < count; ++i) {
    const Sense sense = i % 2 == 0 ? Sense::cw : Sense::ccw;
    runs.push_back(simulation::study::synthetic_drive(
        simulation::study::square_course(side_m, sense), model, "run " + std::to_string(i + 1),
        simulation::study::derived_seed(seed, static_cast<std::uint64_t>(i))));
  }
  return runs;
}

}  // namespace astro::calibration
