#include "host/recording/end_error.hpp"

#include "host/base/error.hpp"
#include "host/recording/rest.hpp"
#include "host/recording/run_metadata.hpp"

namespace astro::recording {
namespace {

/// A run, as sentences and values of errors name it.
struct Named {
  std::string subject, value;
};

[[noreturn]] void refuse(const Named& run, const std::string& fact, EndProblem problem,
                         const std::vector<std::string>& more = {}) {
  std::vector<std::string> values{run.value};
  values.insert(values.end(), more.begin(), more.end());
  throw Error(run.subject + fact, problem, values);
}

Rest required(const std::optional<Rest>& rest, const Run& recorded, const Named& run,
              const std::string& end) {
  if (!rest)
    refuse(run, " does not stand still for 0.2 s at its " + end + ": record a standstill there",
           EndProblem::no_rest, {end});
  if (!rest->truth)
    refuse(
        run,
        " has no valid ground truth while it stands at its " + end + ": check that " +
            (recorded.scans.empty() ? "the tracker sees the robot there"
                                    : "the laser scanner sees walls in two directions there, and at the end "
                                      "those that it sees at the start"),
        EndProblem::no_truth, {end});
  return *rest;
}

}  // namespace

RunEnds ends_of(const Run& run, const std::string& file) {
  const Named named =
      file.empty() ? Named{run_name(run.info), run_name(run.info)} : Named{"'" + file + "'", file};
  if (run.odometry.empty()) refuse(named, " holds no odometry: record it again", EndProblem::no_odometry);
  const Rest start = required(rest_at_start(run), run, named, "start");
  const Rest end = required(rest_at_end(run), run, named, "end");
  if (start.to_us >= end.from_us)
    refuse(named, " never moves: its wheel counts stay the same from start to end", EndProblem::never_moves);
  if (!std::isfinite(start.truth->theta_rad))
    refuse(named, " has no heading of ground truth at its start: without it the end cannot be placed",
           EndProblem::no_heading);
  return {start.truth->between(*end.truth), start.odometry.between(end.odometry)};
}

Pose2 end_error(const Run& run) {
  const auto [absolute, odometry] = ends_of(run);
  return difference(absolute, odometry);
}

}  // namespace astro::recording
