#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "host/experiment/analysis/recordings.hpp"
#include "host/experiment/drive/doubtful_run.hpp"
#include "host/experiment/files/plan.hpp"

namespace astro::experiment {

/// The recordings of the phase that an experiment is driving. They are read from the disk, so that exactly what was saved is
/// calibrated and reported. Each file is read once, although the runs are evaluated repeatedly while the phase grows.
///
/// Errors  read() and doubtful() throw what recording::read_run throws.
class PhaseRecordings {
 public:
  explicit PhaseRecordings(std::filesystem::path folder) : folder_(std::move(folder)) { start(); }

  /// Begins again without recordings. Those that recordings() returned stay as they are.
  void start();

  /// Reads the recordings of `specs` that were not read yet. Precondition: `specs` begins with those that were
  /// read, or those begin with `specs`.
  void read(std::span<const RunSpec> specs);

  /// How many runs were read.
  std::size_t size() const { return specs_.size(); }
  std::shared_ptr<const Recordings> recordings() const { return recordings_; }

  /// Reads these recordings as read() does, with the same precondition, and returns the doubtful_runs among them.
  std::vector<DoubtfulRun> doubtful(std::span<const RunSpec> specs);

 private:
  std::filesystem::path folder_;
  std::shared_ptr<Recordings> recordings_;
  std::vector<RunSpec> specs_;  // of recordings_, in its order
};

}  // namespace astro::experiment
