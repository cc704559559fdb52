#include "host/simulation/study/kinematic_source.hpp"

#include "host/simulation/study/synthetic_drive.hpp"

namespace astro::simulation::study {
namespace {

using calibration::Trajectory;

DriveModel model_of(const TrialSetup& setup) {
  DriveModel model;
  model.loaded = setup.loaded();
  model.actual = setup.actual();
  model.noise = setup.noise;
  model.count_rate_hz = setup.count_rate_hz;
  model.truth_rate_hz = setup.truth_rate_hz;
  return model;
}

Trajectory square(const TrialSetup& setup, int run, const DriveModel& model, std::uint64_t seed) {
  return synthetic_drive(square_course(setup.side_m, sense_of(run)), model, name_of(run), seed);
}

}  // namespace

void KinematicSource::check(const TrialSetup& setup) const {
  setup.require(Model::kinematic);
  setup.check();
}

Drives KinematicSource::of_trial(const TrialSetup& setup, int trial) const {
  const std::uint64_t seed = seed_of(setup, trial);
  const std::vector<double> offsets_s = clock_offsets_s(setup, trial);
  DriveModel model = model_of(setup);
  Drives drives;
  for (int run = 0; run < 2 * setup.runs; ++run) {
    model.clock_offset_s = offsets_s[static_cast<std::size_t>(run)];
    drives.runs.push_back(square(setup, run, model, derived_seed(seed, static_cast<std::uint64_t>(run))));
    drives.end_errors.push_back(end_error(drives.runs.back(), setup.loaded()));
  }
  return drives;
}

std::vector<Trajectory> KinematicSource::without_noise(const TrialSetup& setup) const {
  DriveModel model = model_of(setup);
  model.noise = {0, 0, 0};
  std::vector<Trajectory> drives;
  for (int run = 0; run < 2 * setup.runs; ++run) drives.push_back(square(setup, run, model, 0));
  return drives;
}

}  // namespace astro::simulation::study
