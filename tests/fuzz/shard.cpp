// Shards of a study, and their merge.
#include "host/base/error.hpp"
#include "host/simulation/study/shard_file.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  try {
    const simulation::study::ShardFile part =
        simulation::study::read_shard_file(std::string(text_of(input)), "x.json");
    const auto trials = simulation::study::merge({part});
    require(trials.size() == static_cast<std::size_t>(part.setup.trials), "a merged study is whole");
    require(simulation::study::merge({simulation::study::read_shard_file(
                                         simulation::study::to_text(part.setup, trials), "y.json")})
                    .size() == trials.size(),
            "a study comes back from its text");
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  simulation::study::TrialSetup setup;
  setup.trials = 2;
  std::vector<simulation::study::Trial> trials(2);
  trials[1].index = 1;
  trials[1].ml_chi_square = 1;
  trials[1].failure = "why";
  trials[0].errors[0] = simulation::study::Errors{};
  return {bytes_of(simulation::study::to_text(setup, trials)),
          bytes_of(simulation::study::to_text(setup, {trials[1]}))};
}

}  // namespace astro::fuzz
