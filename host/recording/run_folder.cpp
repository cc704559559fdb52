#include "host/recording/run_folder.hpp"

#include <algorithm>

#include "host/base/error.hpp"
#include "host/base/parallel.hpp"
#include "host/base/text/natural_order.hpp"
#include "host/recording/recording_problem.hpp"

namespace astro::recording {
namespace fs = std::filesystem;
namespace {

Error unreadable(const fs::path& folder, const std::error_code& why) {
  return Error("cannot list the folder " + folder.string() + ": " + why.message(),
               RecordingProblem::folder_unreadable, {folder.string(), why.message()});
}

}  // namespace

std::vector<fs::path> list_runs(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::status_known(status)) throw unreadable(folder, error);
  if (!fs::exists(status))
    throw Error(folder.string() + " does not exist: name a folder that holds recorded runs",
                RecordingProblem::folder_missing, {folder.string()});
  if (!fs::is_directory(folder, error))
    throw Error(folder.string() + " is a file: name a folder that holds recorded runs",
                RecordingProblem::folder_is_file, {folder.string()});
  std::vector<fs::path> paths;
  for (auto it = fs::recursive_directory_iterator(folder, error);
       !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    if (it->path().extension() == ".mcap" && it->is_regular_file()) paths.push_back(it->path());
  }
  if (error) throw unreadable(folder, error);
  if (paths.empty()) {
    throw Error("no recordings (*.mcap) in " + folder.string(), RecordingProblem::none_in_folder,
                {folder.string()});
  }
  std::sort(paths.begin(), paths.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.generic_string(), b.generic_string());
  });
  return paths;
}

std::vector<Run> read_runs(std::span<const fs::path> files, Damage damage) {
  std::vector<Run> runs(files.size());
  in_parallel(static_cast<int>(files.size()), [&](int i) {
    const auto file = static_cast<std::size_t>(i);
    runs[file] = read_run(files[file], damage);
  });
  return runs;
}

std::vector<Run> read_runs(const fs::path& folder, Damage damage) {
  return read_runs(list_runs(folder), damage);
}

}  // namespace astro::recording
