// experiment.json, and what follows from its plan.
#include <fstream>
#include <iterator>

#include "host/base/error.hpp"
#include "host/experiment/files/journal.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  static const InputFile file("experiment.json");
  file.holding(input);
  try {
    const experiment::Journal journal = experiment::read_journal(file.folder());
    const experiment::Plan& plan = journal.plan;
    for (std::size_t phase = 0; phase < experiment::phase_names(plan).size(); ++phase)
      require(experiment::runs_of_phase(plan, phase, plan.runs).size() <= 2003, "a plan can be driven");
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  const InputFile file("experiment.json");
  std::vector<Bytes> all;
  for (const bool until : {false, true}) {
    experiment::Journal journal;
    journal.plan.truth = "sim";
    if (until) journal.plan.until = experiment::Until{0.001, 5};
    journal.loaded["before"] = {1, 1, 0.29};
    experiment::write_journal(file.folder(), journal);
    std::ifstream text(file.path(), std::ios::binary);
    all.emplace_back((std::istreambuf_iterator<char>(text)), std::istreambuf_iterator<char>());
  }
  return all;
}

}  // namespace astro::fuzz
