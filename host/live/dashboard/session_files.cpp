#include "host/live/dashboard/session_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "host/base/error.hpp"
#include "host/base/system_error.hpp"

namespace astro::dashboard {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 200;

int digit(char c) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const char lower = c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c;
  const std::size_t at = kDigits.find(lower);
  return at == kDigits.npos ? -1 : static_cast<int>(at);
}

}  // namespace

SessionFiles::SessionFiles() {
  std::string pattern = (fs::temp_directory_path() / "page-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw system_error("no temporary folder can be made at " + pattern, errno);
  folder_ = pattern;
}

SessionFiles::~SessionFiles() {
  std::error_code ignored;
  if (!stays_) fs::remove_all(folder_, ignored);
}

std::uint64_t SessionFiles::room() const {
  std::uint64_t used = 0;
  std::error_code gone;  // a call may remove files meanwhile
  for (fs::recursive_directory_iterator at(folder_, gone), end; at != end && !gone; at.increment(gone))
    if (const std::uintmax_t size = at->file_size(gone); !gone && at->is_regular_file(gone)) used += size;
  return used < kMostBytes ? kMostBytes - used : 0;
}

std::optional<fs::path> SessionFiles::place_of(const std::string& name) const {
  const fs::path path(name);
  const bool plain = !name.empty() && name.size() <= kLongestName && name.find('\0') == name.npos &&
                     name.front() != '.' && path == path.filename();
  return plain ? std::optional(folder_ / path) : std::nullopt;
}

std::optional<fs::path> SessionFiles::find(const std::string& path) const {
  const fs::path relative = fs::path(path).lexically_normal();
  if (relative.empty() || relative.is_absolute() || *relative.begin() == ".." || path.find('\0') != path.npos)
    return std::nullopt;
  std::error_code gone;
  // A link that a file of this name could be does not lead out of the folder.
  const fs::path real = fs::canonical(folder_ / relative, gone), root = fs::canonical(folder_, gone);
  if (gone || !fs::is_regular_file(real, gone)) return std::nullopt;
  const auto ends = std::mismatch(root.begin(), root.end(), real.begin(), real.end());
  return ends.first == root.end() ? std::optional(real) : std::nullopt;
}

fs::path SessionFiles::keep(const fs::path& file, const fs::path& to) {
  fs::path kept = to / file.filename();
  for (int i = 2; fs::exists(kept); ++i)
    kept = to / fmt::format("{}-{}{}", file.stem().string(), i, file.extension().string());
  std::error_code failed;
  fs::create_directories(to, failed);
  if (!failed) fs::copy_file(file, kept, failed);
  if (!failed) return fs::weakly_canonical(kept);
  std::error_code ignored;
  // The part for which the disk had room; but not what somebody else has put there meanwhile.
  if (failed != std::errc::file_exists) fs::remove(kept, ignored);
  stays_ = true;
  throw Error(fmt::format("{} cannot be written ({}): the recording stays at {}", kept.string(),
                          failed.message(), file.string()));
}

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (i + 2 >= text.size() || digit(text[i + 1]) < 0 || digit(text[i + 2]) < 0) return std::nullopt;
    decoded += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
    i += 2;
  }
  return decoded;
}

}  // namespace astro::dashboard
