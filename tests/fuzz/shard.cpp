// Shards of a study, and their merge.
#include "host/base/error.hpp"
#include "host/study/shard_file.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  try {
    const study::Part part = study::read_part(std::string(text_of(input)), "x.json");
    const auto trials = study::merge({part});
    require(trials.size() == static_cast<std::size_t>(part.setup.trials), "a merged study is whole");
    require(study::merge({study::read_part(study::to_text(part.setup, trials), "y.json")}).size() ==
                trials.size(),
            "a study comes back from its text");
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  study::TrialSetup setup;
  setup.trials = 2;
  std::vector<study::Trial> trials(2);
  trials[1].index = 1;
  trials[1].ml_chi_square = 1;
  trials[1].failure = "why";
  trials[0].errors[0] = study::Errors{};
  return {bytes_of(study::to_text(setup, trials)), bytes_of(study::to_text(setup, {trials[1]}))};
}

}  // namespace astro::fuzz
