#include "host/recording/end_error.hpp"

#include "host/base/error.hpp"
#include "host/recording/rest.hpp"
#include "host/recording/run_metadata.hpp"

namespace astro::recording {
namespace {

Rest required(const std::optional<Rest>& rest, const Run& run, const std::string& end) {
  if (!rest) {
    throw Error(
        run_name(run.info) + " does not stand still for 0.2 s at its " + end + ": record a standstill there",
        EndProblem::no_rest, {run_name(run.info), end});
  }
  if (!rest->truth) {
    throw Error(run_name(run.info) + " has no valid ground truth while it stands at its " + end +
                    ": check that the tracker sees the robot there",
                EndProblem::no_truth, {run_name(run.info), end});
  }
  return *rest;
}

}  // namespace

RunEnds ends_of(const Run& run) {
  if (run.odometry.empty())
    throw Error(run_name(run.info) + " holds no odometry: record it again", EndProblem::no_odometry,
                {run_name(run.info)});
  const Rest start = required(rest_at_start(run), run, "start");
  const Rest end = required(rest_at_end(run), run, "end");
  if (start.to_us >= end.from_us) {
    throw Error(run_name(run.info) + " never moves: its wheel counts stay the same from start to end",
                EndProblem::never_moves, {run_name(run.info)});
  }
  if (!std::isfinite(start.truth->theta_rad)) {
    throw Error(run_name(run.info) +
                    " has no heading of ground truth at its start: without it the end cannot be placed",
                EndProblem::no_heading, {run_name(run.info)});
  }
  return {start.truth->between(*end.truth), start.odometry.between(end.odometry)};
}

Pose2 end_error(const Run& run) {
  const auto [absolute, odometry] = ends_of(run);
  return difference(absolute, odometry);
}

}  // namespace astro::recording
