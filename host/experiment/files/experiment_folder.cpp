#include "host/experiment/files/experiment_folder.hpp"

#include <algorithm>

#include "host/recording/run_folder.hpp"

namespace astro::experiment {

namespace fs = std::filesystem;

int recorded_squares(const fs::path& folder, const Plan& plan, std::size_t phase) {
  for (int squares = 1;; ++squares) {
    const std::vector<RunSpec> specs = squares_of_phase(plan, phase, squares);
    if (!std::all_of(specs.begin(), specs.end(),
                     [&](const RunSpec& spec) { return fs::exists(file_of(folder, spec)); }))
      return squares - 1;
  }
}

int squares_in_phase(const fs::path& folder, const Plan& plan, std::size_t phase) {
  return open_ended(plan, phase) ? std::max(kFewestPairs, recorded_squares(folder, plan, phase)) : plan.runs;
}

fs::path file_of(const fs::path& folder, const RunSpec& spec) {
  return folder / spec.phase / spec.file_name();
}

fs::path file_without_truth(const fs::path& folder, const RunSpec& spec) {
  return file_of(folder, spec) += ".no-truth";
}

const RunSpec* first_missing(const fs::path& folder, const std::vector<RunSpec>& specs) {
  const auto missing =
      std::ranges::find_if(specs, [&](const RunSpec& spec) { return !fs::exists(file_of(folder, spec)); });
  return missing == specs.end() ? nullptr : &*missing;
}

RunSet read_specs(const fs::path& folder, const std::vector<RunSpec>& specs, recording::Damage damage) {
  RunSet set;
  std::vector<fs::path> files;
  for (const RunSpec& spec : specs) {
    files.push_back(file_of(folder, spec));
    set.names.push_back(spec.phase + "/" + files.back().stem().string());
  }
  set.runs = recording::read_runs(files, damage);
  return set;
}

}  // namespace astro::experiment
