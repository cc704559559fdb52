#include "host/recording/run_folder.hpp"

#include <algorithm>

#include "host/base/error.hpp"
#include "host/base/text/natural_order.hpp"

namespace astro::recording {
namespace fs = std::filesystem;

std::vector<fs::path> list_runs(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::status_known(status))
    throw Error("cannot list the folder " + folder.string() + ": " + error.message());
  if (!fs::exists(status))
    throw Error(folder.string() + " does not exist: name a folder that holds recorded runs");
  if (!fs::is_directory(folder, error))
    throw Error(folder.string() + " is a file: name a folder that holds recorded runs");
  std::vector<fs::path> paths;
  for (auto it = fs::recursive_directory_iterator(folder, error);
       !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    if (it->path().extension() == ".mcap" && it->is_regular_file()) paths.push_back(it->path());
  }
  if (error) throw Error("cannot list the folder " + folder.string() + ": " + error.message());
  if (paths.empty()) {
    throw Error("no recordings (*.mcap) in " + folder.string(), RecordingProblem::none_in_folder);
  }
  std::sort(paths.begin(), paths.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.generic_string(), b.generic_string());
  });
  return paths;
}

std::vector<Run> read_runs(const fs::path& folder, Damage damage) {
  std::vector<Run> runs;
  for (const fs::path& path : list_runs(folder)) runs.push_back(read_run(path, damage));
  return runs;
}

}  // namespace astro::recording
