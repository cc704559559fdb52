#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/recording/run.hpp"

namespace astro::experiment {

/// Recordings that were read once, with what calibrations, tables and reports derive from them. Each result
/// is computed when it is asked for first and kept, so that no count is converted twice.
///
/// Not safe for use by several threads at once.
class Recordings {
 public:
  Recordings() = default;
  Recordings(RunSet set) : set_(std::move(set)) {}  // NOLINT(google-explicit-constructor): the same runs

  /// Appends runs; either all runs name their sessions or none does. Trajectories of the earlier runs are not converted
  /// again, but may move in memory.
  void add(RunSet more);

  const RunSet& set() const { return set_; }
  const std::vector<std::string>& names() const { return set_.names; }
  const std::vector<recording::Run>& runs() const { return set_.runs; }

  /// What trajectories_of returns; throws as it does.
  const std::vector<calibration::Trajectory>& trajectories() const;

  /// What squares_of returns; throws as it does.
  const Squares& squares() const;

 private:
  RunSet set_;
  mutable std::vector<calibration::Trajectory> trajectories_;  // of the first runs
  mutable std::optional<Squares> squares_;
};

}  // namespace astro::experiment
