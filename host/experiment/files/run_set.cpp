#include "host/experiment/files/run_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/base/error.hpp"
#include "host/experiment/files/run_set_problem.hpp"
#include "host/recording/run_folder.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

std::string run_name(const fs::path& file, const fs::path& folder) {
  return file.lexically_relative(folder).replace_extension().generic_string();
}

/// The first names and the number of the others.
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
  const auto wanted_and = [&](const std::vector<std::string>& others) {
    std::vector<std::string> values{wanted};
    values.insert(values.end(), others.begin(), others.end());
    return values;
  };
  if (matches.empty())
    throw Error(fmt::format("there is no recording '{}' in {} to leave out: it holds {}", wanted,
                            folder.string(), listed(names)),
                RunSetProblem::no_such_name, wanted_and(names));
  if (matches.size() > 1)
    throw Error(fmt::format("'{}' may be {}: name the one to leave out", wanted, fmt::join(matches, " or ")),
                RunSetProblem::ambiguous_name, wanted_and(matches));
  return matches.front();
}

/// Refuses copies of a recording, because they would make the standard errors too small.
void require_no_copies(const RunSet& set) {
  const auto is_copy = [](const recording::Run& a, const recording::Run& b) {
    return a.info.started_at == b.info.started_at && a.odometry.size() == b.odometry.size() &&
           !a.odometry.empty() && a.odometry.front().time_us == b.odometry.front().time_us &&
           a.odometry.back().time_us == b.odometry.back().time_us &&
           a.odometry.back().left_counts == b.odometry.back().left_counts &&
           a.odometry.back().right_counts == b.odometry.back().right_counts;
  };
  for (std::size_t i = 0; i < set.runs.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (is_copy(set.runs[i], set.runs[k]))
        throw Error(fmt::format("{} and {} are the same recording", set.names[k], set.names[i]),
                    RunSetProblem::same_recording, {set.names[i]});
}

}  // namespace

RunSet read_run_set(const fs::path& folder, std::span<const std::string> without, recording::Damage damage) {
  const std::vector<fs::path> files = recording::list_runs(folder);
  std::vector<std::string> names, left_out;
  for (const fs::path& file : files) names.push_back(run_name(file, folder));
  for (const std::string& wanted : without) left_out.push_back(matched(wanted, names, folder));
  RunSet set;
  std::vector<fs::path> kept;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (std::find(left_out.begin(), left_out.end(), names[i]) != left_out.end()) continue;
    set.names.push_back(names[i]);
    kept.push_back(files[i]);
  }
  set.runs = recording::read_runs(kept, damage);
  if (set.runs.empty())
    throw Error("every recording in " + folder.string() + " is left out: keep some to calibrate from");
  require_no_copies(set);
  return set;
}

}  // namespace astro::experiment
