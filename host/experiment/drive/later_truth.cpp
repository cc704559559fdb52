#include "host/experiment/drive/later_truth.hpp"

#include "host/experiment/files/experiment_folder.hpp"
#include "host/recording/files/run_file.hpp"

namespace astro::experiment {
namespace {

RunSet without_truth(const std::filesystem::path& folder, const std::vector<RunSpec>& specs,
                     const std::string& source) {
  RunSet set;
  for (const RunSpec& spec : specs) {
    recording::Run run = recording::read_run(file_of(folder, spec));
    if (run.info.truth_source != source || !run.truth.empty()) continue;
    set.names.push_back(
        file_of(folder, spec).lexically_relative(folder).replace_extension().generic_string());
    set.runs.push_back(std::move(run));
  }
  return set;
}

}  // namespace

bool complete_later(const std::filesystem::path& folder, const std::vector<RunSpec>& specs,
                    const std::string& source, const std::vector<std::string>& others,
                    const GiveTruth& give) {
  RunSet set = without_truth(folder, specs, source);
  if (set.runs.empty()) return false;
  while (!set.runs.empty()) {
    give(specs.front().phase, set, others);
    for (std::size_t i = 0; i < set.runs.size(); ++i) {
      if (set.runs[i].truth.empty()) continue;
      std::filesystem::path file = folder / set.names[i];
      recording::write_run(file += ".mcap", set.runs[i]);
    }
    set = without_truth(folder, specs, source);
  }
  return true;
}

}  // namespace astro::experiment
