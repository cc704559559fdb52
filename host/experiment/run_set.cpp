#include "host/experiment/run_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/base/error.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/run_folder.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

std::string name_of(const fs::path& file, const fs::path& folder) {
  return file.lexically_relative(folder).replace_extension().generic_string();
}

/// The first few, and how many more there are.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 8;
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kShown));
  const std::string text = fmt::format("{}", fmt::join(names.begin(), end, ", "));
  return names.size() <= kShown ? text : text + fmt::format(" and {} more", names.size() - kShown);
}

std::string matched(const std::string& wanted, const std::vector<std::string>& names,
                    const fs::path& folder) {
  if (std::find(names.begin(), names.end(), wanted) != names.end()) return wanted;
  std::vector<std::string> matches;
  for (const std::string& name : names)
    if (fs::path(name).filename() == wanted) matches.push_back(name);
  if (matches.empty())
    throw Error(fmt::format("there is no recording '{}' in {} to leave out: it holds {}", wanted,
                            folder.string(), listed(names)));
  if (matches.size() > 1)
    throw Error(fmt::format("'{}' may be {}: name the one to leave out", wanted, fmt::join(matches, " or ")));
  return matches.front();
}

}  // namespace

RunSet read_run_set(const fs::path& folder, std::span<const std::string> without) {
  const std::vector<fs::path> files = recording::list_runs(folder);
  std::vector<std::string> names, left_out;
  for (const fs::path& file : files) names.push_back(name_of(file, folder));
  for (const std::string& wanted : without) left_out.push_back(matched(wanted, names, folder));
  RunSet set;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (std::find(left_out.begin(), left_out.end(), names[i]) != left_out.end()) continue;
    set.names.push_back(names[i]);
    set.runs.push_back(recording::read_run(files[i]));
  }
  if (set.runs.empty())
    throw Error("every recording in " + folder.string() + " is left out: keep some to calibrate from");
  return set;
}

}  // namespace astro::experiment
