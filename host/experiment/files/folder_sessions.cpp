#include "host/experiment/files/folder_sessions.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

/// Links to folders are followed, because a session is where its files are; a link to a single file is not.
fs::path folder_of(const fs::path& file) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  const fs::path folder = (whole.has_filename() ? whole : whole.parent_path()).parent_path();
  std::error_code unreadable;
  const fs::path canonical = fs::weakly_canonical(folder, unreadable);
  return unreadable ? folder : canonical;
}

/// The last `parts` parts of a folder, or its whole path if it has no more.
std::string tail_of(const fs::path& folder, std::size_t parts) {
  fs::path tail = folder.filename(), above = folder.parent_path();
  for (; parts > 1 && above.has_filename(); --parts, above = above.parent_path())
    tail = above.filename() / tail;
  return parts > 1 || tail.empty() ? folder.string() : tail.string();
}

std::size_t depth_of(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(folder.begin(), folder.end()));
}

/// Whether no two folders have the same name.
bool tells_apart(const std::map<fs::path, std::string>& names) {
  std::vector<std::string> all;
  for (const auto& [folder, name] : names) all.push_back(name);
  std::ranges::sort(all);
  return std::ranges::adjacent_find(all) == all.end();
}

}  // namespace

std::vector<std::string> sessions_by_folder(std::span<const fs::path> files) {
  std::vector<fs::path> folders;
  std::map<fs::path, std::string> names;
  std::size_t deepest = 1;
  for (const fs::path& file : files) {
    names[folders.emplace_back(folder_of(file))];
    deepest = std::max(deepest, depth_of(folders.back()));
  }
  // Whole paths are unique, so the loop ends with unique names at the latest when it uses whole paths.
  for (std::size_t parts = 1; parts <= deepest; ++parts) {
    for (auto& [folder, name] : names) name = tail_of(folder, parts);
    if (tells_apart(names)) break;
  }
  std::vector<std::string> sessions;
  for (const fs::path& folder : folders) sessions.push_back(names[folder]);
  return sessions;
}

std::vector<std::string> sessions_by_folder(std::span<const fs::path> wheels,
                                            std::span<const fs::path> truth) {
  std::vector<std::string> sessions = sessions_by_folder(truth);
  const std::vector<std::string> of_wheels = sessions_by_folder(wheels);
  for (std::size_t i = 0; i < sessions.size(); ++i)
    if (folder_of(wheels[i]) != folder_of(truth[i])) sessions[i] += " with " + of_wheels[i];
  return sessions;
}

std::vector<std::string> sessions_by_folder(const RunSet& set, const fs::path& folder) {
  std::vector<fs::path> files;
  for (const std::string& name : set.names) files.push_back(folder / name);
  return sessions_by_folder(files);
}

}  // namespace astro::experiment
