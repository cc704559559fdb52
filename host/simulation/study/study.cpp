#include "host/simulation/study/study.hpp"

#include <string>

#include "host/base/error.hpp"
#include "host/base/parallel.hpp"
#include "host/simulation/study/shard_file.hpp"

namespace astro::simulation::study {

std::vector<Trial> run_study(const TrialSetup& setup, const DriveSource& source, const Shard& shard, int jobs,
                             const std::function<void(int done, int total)>& meanwhile) {
  source.check(setup);
  const int begin = shard.begin(setup.trials), count = shard.end(setup.trials) - begin;
  if (count < 1)
    throw Error("shard " + std::to_string(shard.number) + "/" + std::to_string(shard.of) + " of " +
                    std::to_string(setup.trials) + " trials is empty: make fewer shards or more trials",
                StudyProblem::shard_empty,
                {std::to_string(shard.number), std::to_string(shard.of), std::to_string(setup.trials)});
  std::vector<Trial> trials(static_cast<std::size_t>(count));
  in_parallel(
      count, jobs, [&](int i) { trials[static_cast<std::size_t>(i)] = run_trial(setup, source, begin + i); },
      [&](int done) { meanwhile(done, count); });
  return trials;
}

}  // namespace astro::simulation::study
