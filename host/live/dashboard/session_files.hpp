#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace astro::dashboard {

/// The files of one session: what people drop into a page, and what calls write. They are in a temporary folder of this user alone,
/// which goes with the session.
class SessionFiles {
 public:
  static constexpr std::uint64_t kMostBytes = std::uint64_t{2} << 30;  // of all files together

  /// Throws astro::Error if there can be no folder.
  SessionFiles();
  ~SessionFiles();
  SessionFiles(const SessionFiles&) = delete;
  SessionFiles& operator=(const SessionFiles&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  /// How many bytes more fit.
  std::uint64_t room() const;
  /// Where the file of this name belongs; nothing for a name with folders in it.
  std::optional<std::filesystem::path> place_of(const std::string& name) const;
  /// A file of this session, also in a folder that a call has made; nothing if there is none, or if the path leads elsewhere.
  std::optional<std::filesystem::path> find(const std::string& path) const;

  /// Copies a file of this session into the folder `to`, under a name that nothing has there; answers its path. Throws astro::Error
  /// if it cannot, and then the files of this session stay.
  std::filesystem::path keep(const std::filesystem::path& file, const std::filesystem::path& to);

 private:
  std::filesystem::path folder_;
  bool stays_ = false;
};

/// "%41b" as "Ab"; nothing for a malformed text.
std::optional<std::string> percent_decoded(std::string_view text);

}  // namespace astro::dashboard
