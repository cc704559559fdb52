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

/// Ten drives that are no squares: lines, arcs and spins both ways round, so that their ends alone show all three factors.
inline std::vector<Trajectory> varied_drives(const simulation::study::DriveModel& model,
                                             std::uint64_t seed = kSeed) {
  using namespace simulation::study;
  std::vector<Trajectory> runs;
  for (const Course& course : {line_course(4), circle_course(1, 5), circle_course(1, -5),
                               circle_course(0.5, 9), circle_course(0.5, -9), spin_course(20),
                               spin_course(-20), line_course(4), circle_course(2, 3), circle_course(2, -3)})
    runs.push_back(synthetic_drive(course, model, "run " + std::to_string(runs.size() + 1),
                                   derived_seed(seed, runs.size())));
  return runs;
}

}  // namespace astro::calibration
