#pragma once

#include <functional>
#include <vector>

#include "host/simulation/study/drive_source.hpp"
#include "host/simulation/study/setup.hpp"
#include "host/simulation/study/trial.hpp"

/// Monte Carlo of calibration methods, whole or in shards.
namespace astro::simulation::study {

/// Part `number` of `of`: a block of neighbouring trials. 1/1 is the whole.
struct Shard {
  int number = 1, of = 1;

  /// Index of the first trial, and one past the last.
  int begin(int trials) const { return block_end(number - 1, trials); }
  int end(int trials) const { return block_end(number, trials); }

 private:
  int block_end(int block, int trials) const {
    return static_cast<int>(static_cast<long long>(trials) * block / of);
  }
};

/// The trials of the shard, in order. Each depends on (setup, index) alone: neither `jobs`, the number of
/// threads, nor the shards change a bit of it.
///
/// `meanwhile(done, total)` is called in the caller's thread, see in_parallel; its exceptions pass through.
/// Throws astro::Error for a set-up that `source` cannot drive, and for a shard without a trial.
std::vector<Trial> run_study(const TrialSetup& setup, const DriveSource& source, const Shard& shard, int jobs,
                             const std::function<void(int done, int total)>& meanwhile);

}  // namespace astro::simulation::study
