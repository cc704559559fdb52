#include "host/simulation/study/kinematic_source.hpp"

#include <numbers>

#include "host/base/text/sense.hpp"
#include "host/simulation/study/synthetic_drive.hpp"

namespace astro::simulation::study {
namespace {

using calibration::Trajectory;

DriveModel model_of(const TrialSetup& setup) {
  DriveModel model;
  model.loaded = setup.loaded();
  model.actual = setup.actual();
  model.noise = setup.noise;
  model.windup_rad = setup.windup_rad;
  model.count_rate_hz = setup.count_rate_hz;
  model.truth_rate_hz = setup.truth_rate_hz;
  return model;
}

Course course_of(const TrialSetup& setup, int run) {
  const Sense sense = sense_of(run);
  if (!setup.is_square(run))
    return circle_course(setup.circle_radius_m, sign_of(sense) * kCircleTurns * 2 * std::numbers::pi);
  return setup.windup_rad > 0 ? square_course_with_stands(setup.side_m, sense)
                              : square_course(setup.side_m, sense);
}

Trajectory driven(const TrialSetup& setup, int run, const DriveModel& model, std::uint64_t seed) {
  return synthetic_drive(course_of(setup, run), model, name_of(setup, run), seed);
}

/// The end error of the square itself, without the line after it.
calibration::EndPose end_error_of(Trajectory run, const TrialSetup& setup, const DriveModel& model) {
  if (setup.windup_rad > 0) {
    const double line_s = kEndLine_m / model.speed_mps + model.speed_mps / model.acceleration_mps2;
    const auto after = [&](const auto& samples) {
      return [end_s = samples.back().time_s - line_s - kStand_s](const auto& sample) {
        return sample.time_s > end_s;
      };
    };
    std::erase_if(run.wheels, after(run.wheels));
    std::erase_if(run.truth, after(run.truth));
  }
  return end_error(run, setup.loaded());
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
  for (int run = 0; run < setup.run_count(); ++run) {
    model.clock_offset_s = offsets_s[static_cast<std::size_t>(run)];
    drives.runs.push_back(driven(setup, run, model, derived_seed(seed, static_cast<std::uint64_t>(run))));
    if (setup.is_square(run)) drives.end_errors.push_back(end_error_of(drives.runs.back(), setup, model));
  }
  return drives;
}

std::vector<Trajectory> KinematicSource::without_noise(const TrialSetup& setup) const {
  DriveModel model = model_of(setup);
  model.noise = {0, 0, 0};
  model.windup_rad = 0;
  std::vector<Trajectory> drives;
  for (int run = 0; run < setup.run_count(); ++run) drives.push_back(driven(setup, run, model, 0));
  return drives;
}

}  // namespace astro::simulation::study
