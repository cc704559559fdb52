#include "host/import/drives/file_pairs.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace astro::importing {
namespace {

/// A word of a name in lower case, or a number without its leading zeros. Numbers sort by value.
struct NamePart {
  bool number = false;
  std::size_t digits = 0;
  std::string text;

  auto operator<=>(const NamePart&) const = default;
};

enum class Letter { mark, digit, word };

Letter kind_of(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (std::isdigit(byte) != 0) return Letter::digit;
  return std::isalpha(byte) != 0 || byte >= 0x80 ? Letter::word : Letter::mark;
}

std::vector<NamePart> parts_of(std::string_view name) {
  std::vector<NamePart> parts;
  while (!name.empty()) {
    const Letter kind = kind_of(name.front());
    const auto end = std::ranges::find_if(name, [&](char c) { return kind_of(c) != kind; });
    std::string text(name.begin(), end);
    name.remove_prefix(text.size());
    if (kind == Letter::mark) continue;
    if (kind == Letter::digit) text.erase(0, std::min(text.find_first_not_of('0'), text.size() - 1));
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    parts.push_back({kind == Letter::digit, kind == Letter::digit ? text.size() : 0, text});
  }
  return parts;
}

struct NamedFile {
  std::filesystem::path path;
  std::vector<NamePart> parts;

  bool operator<(const NamedFile& other) const {
    return parts != other.parts ? parts < other.parts : path < other.path;
  }
};

std::vector<NamedFile> sorted(std::span<const OfferedFile> files, bool wheels, bool truth) {
  std::vector<NamedFile> named;
  for (const OfferedFile& file : files)
    if (file.wheels == wheels && file.truth == truth)
      named.push_back({file.path, parts_of(file.path.filename().string())});
  std::ranges::sort(named, std::less<>());
  return named;
}

/// How much the names of two files have in common that those of the others have not.
class Likeness {
 public:
  Likeness(const std::vector<NamedFile>& wheels, const std::vector<NamedFile>& truth) {
    for (const auto* files : {&wheels, &truth})
      for (const NamedFile& file : *files)
        for (const NamePart& part : distinct(file)) ++files_with_[part];
  }
  double of(const NamedFile& a, const NamedFile& b) const {
    const std::set<NamePart> theirs = distinct(b);
    double sum = 0;
    for (const NamePart& part : distinct(a))
      if (theirs.contains(part)) sum += 1.0 / files_with_.at(part);
    return sum;
  }

 private:
  static std::set<NamePart> distinct(const NamedFile& file) { return {file.parts.begin(), file.parts.end()}; }

  std::map<NamePart, int> files_with_;
};

/// A table of wheels with the robot's own odometry beside them holds poses, too, and is no ground truth where there is other.
std::vector<OfferedFile> with_one_use(std::span<const OfferedFile> files) {
  std::vector<OfferedFile> used(files.begin(), files.end());
  const auto any = [&](bool wheels, bool truth) {
    return std::ranges::any_of(
        files, [&](const OfferedFile& file) { return file.wheels == wheels && file.truth == truth; });
  };
  const bool wheels = any(true, false), truth = any(false, true);
  if (wheels == truth) return used;
  for (OfferedFile& file : used)
    if (file.wheels && file.truth) (truth ? file.truth : file.wheels) = false;
  return used;
}

}  // namespace

std::vector<DriveFiles> pair_files(std::span<const OfferedFile> offered) {
  const std::vector<OfferedFile> files = with_one_use(offered);
  const std::vector<NamedFile> wheels = sorted(files, true, false), truth = sorted(files, false, true);
  const Likeness likeness(wheels, truth);
  struct Pair {
    double alike;
    std::size_t wheels, truth;
  };
  std::vector<Pair> pairs;
  for (std::size_t w = 0; w < wheels.size(); ++w)
    for (std::size_t t = 0; t < truth.size(); ++t) pairs.push_back({likeness.of(wheels[w], truth[t]), w, t});
  std::ranges::stable_sort(pairs, std::greater<>(), &Pair::alike);
  std::vector<std::optional<std::size_t>> truth_of(wheels.size());
  std::vector<bool> taken(truth.size());
  for (const Pair& pair : pairs) {
    if (truth_of[pair.wheels] || taken[pair.truth]) continue;
    truth_of[pair.wheels] = pair.truth;
    taken[pair.truth] = true;
  }
  std::vector<DriveFiles> drives;
  for (const NamedFile& both : sorted(files, true, true)) drives.push_back({both.path, both.path});
  for (std::size_t w = 0; w < wheels.size(); ++w)
    drives.push_back({wheels[w].path, truth_of[w] ? truth[*truth_of[w]].path : std::filesystem::path()});
  for (std::size_t t = 0; t < truth.size(); ++t)
    if (!taken[t]) drives.push_back({{}, truth[t].path});
  return drives;
}

}  // namespace astro::importing
