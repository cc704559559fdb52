#include "host/experiment/analysis/first_drive.hpp"

#include <algorithm>

#include "host/calibration/likelihood/likelihood_problem.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/preparation/preparation_problem.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/experiment/analysis/trajectories.hpp"

namespace astro::experiment {

std::optional<Remark> why_wrong_robot(const recording::Run& run, const std::string& name) {
  using calibration::LikelihoodProblem, calibration::PreparationProblem;
  if (!has_moving_truth(run.info) || run.truth.empty()) return std::nullopt;
  const Kind of_robot[] = {PreparationProblem::mirrored,
                           PreparationProblem::mirrored_or_clockwise,
                           PreparationProblem::heading_stays,
                           PreparationProblem::nothing_in_common,
                           LikelihoodProblem::implausible_factors,
                           LikelihoodProblem::wheelbase_unlike,
                           LikelihoodProblem::wheel_turns_backwards};
  try {
    calibration::MlOptions options;
    options.clock_known = run.info.truth_clock == "robot";
    options.with_e = false;
    const calibration::Trajectory drive = trajectory_of(run, name);
    calibration::estimate_ml({&drive, 1}, loaded_factors(run.info, name), options);
  } catch (const Error& error) {
    // What else may be wrong with one drive alone is no fault of the robot, and the others may mend it.
    if (std::ranges::find(of_robot, error.kind()) != std::end(of_robot)) return error.remark();
  }
  return std::nullopt;
}

}  // namespace astro::experiment
