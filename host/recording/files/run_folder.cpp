#include "host/recording/files/run_folder.hpp"

#include <algorithm>

#include "host/base/error.hpp"

namespace astro::recording {
namespace fs = std::filesystem;
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Cuts a run of digits, or one other character, off the front.
std::string_view take_piece(std::string_view& text) {
  std::size_t size = 1;
  while (is_digit(text[0]) && size < text.size() && is_digit(text[size])) ++size;
  const std::string_view piece = text.substr(0, size);
  text.remove_prefix(size);
  return piece;
}

int compare_pieces(std::string_view a, std::string_view b) {
  if (!is_digit(a[0]) || !is_digit(b[0])) return a.compare(b);
  a.remove_prefix(std::min(a.find_first_not_of('0'), a.size()));
  b.remove_prefix(std::min(b.find_first_not_of('0'), b.size()));
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  std::string_view rest_a = a;
  std::string_view rest_b = b;
  while (!rest_a.empty() && !rest_b.empty()) {
    const std::string_view piece_a = take_piece(rest_a);
    const std::string_view piece_b = take_piece(rest_b);
    if (const int order = compare_pieces(piece_a, piece_b); order != 0) return order < 0;
  }
  if (rest_a.empty() != rest_b.empty()) return rest_a.empty();
  return a < b;  // "1" and "01"
}

std::vector<fs::path> list_runs(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::status_known(status))
    throw Error("cannot list the folder " + folder.string() + ": " + error.message());
  if (!fs::exists(status)) throw Error(folder.string() + " does not exist", {Help::name_folder_of_runs});
  if (!fs::is_directory(folder, error))
    throw Error(folder.string() + " is a file", {Help::name_folder_of_runs});
  std::vector<fs::path> paths;
  for (auto it = fs::recursive_directory_iterator(folder, error);
       !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    if (it->path().extension() == ".mcap" && it->is_regular_file()) paths.push_back(it->path());
  }
  if (error) throw Error("cannot list the folder " + folder.string() + ": " + error.message());
  if (paths.empty()) {
    throw Error("no recordings (*.mcap) in " + folder.string(), {Help::record_runs});
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
