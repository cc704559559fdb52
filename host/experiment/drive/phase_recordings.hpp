#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "host/experiment/analysis/recordings.hpp"
#include "host/experiment/drive/doubtful_run.hpp"
#include "host/experiment/files/plan.hpp"

namespace astro::experiment {

/// The recordings of the phase that an experiment is driving, as they are on disk: what is calibrated and reported is
/// what was kept. Each file is read once, however often the runs are looked at while the phase grows.
///
/// Errors  read() and doubtful() throw what recording::read_run throws.
class PhaseRecordings {
 public:
  explicit PhaseRecordings(std::filesystem::path folder) : folder_(std::move(folder)) { start(); }

  /// Begins with none. Those that recordings() returned stay as they are.
  void start();

  /// Reads the recordings of `specs` that were not read yet. Precondition: `specs` begins with those that were
  /// read, or those begin with `specs`.
  void read(std::span<const RunSpec> specs);

  /// How many runs were read.
  std::size_t size() const { return specs_.size(); }
  std::shared_ptr<const Recordings> recordings() const { return recordings_; }

  /// doubtful_runs among these, which are read if they were not yet; the same precondition.
  std::vector<DoubtfulRun> doubtful(std::span<const RunSpec> specs);

 private:
  std::filesystem::path folder_;
  std::shared_ptr<Recordings> recordings_;
  std::vector<RunSpec> specs_;  // of recordings_, in its order
};

}  // namespace astro::experiment
