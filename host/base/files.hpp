#pragma once

#include <filesystem>

#include "host/base/bytes.hpp"

namespace astro::recording {

/// The largest file that is read as a whole. What holds a few settings is limited to far less.
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{4} << 30;
inline constexpr std::uintmax_t kMaxSettingsBytes = std::uintmax_t{1} << 20;

/// The whole file. Throws astro::Error if it is not there, is no regular file, cannot be read, or is larger
/// than `most_bytes`; a missing file whose `.part` is there is told apart.
Bytes load_file(const std::filesystem::path& path, std::uintmax_t most_bytes = kMaxFileBytes);

/// A file that carries its name only once it is whole. Bytes go to `<path>.part`; commit() brings them to the
/// disk and gives them the name, replacing what had it, but for a recording: nobody can repeat a drive.
/// Without commit a `.part` that holds anything stays, for whoever wants to rescue what was recorded, until
/// the same path is written again. Folders on the way are made.
///
/// Links   a folder on the way may be a link; a `.part` that is one is refused.
/// Errors  astro::Error naming the file and what the system said, or that there is a folder or a recording of
///         that name, or that another program is writing it.
class PartFile {
 public:
  enum class Replaces { all_but_recordings, recordings_too };
  explicit PartFile(std::filesystem::path path, Replaces replaces = Replaces::all_but_recordings);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// The operating system has the bytes on return: they survive the death of this process, not that of the
  /// machine.
  void write(ByteView bytes);
  void commit();

 private:
  void open_part();
  std::string why_not(const std::string& what) const;  // by errno
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void give_up(const std::string& sentence);

  std::filesystem::path path_, part_;
  int descriptor_ = -1;
  bool empty_ = true;
};

}  // namespace astro::recording
