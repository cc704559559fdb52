#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "host/base/bytes.hpp"
#include "host/base/descriptor.hpp"
#include "host/base/error.hpp"

namespace astro {

/// The largest file that is read as a whole. A file with a few settings is limited to far less.
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{4} << 30;
inline constexpr std::uintmax_t kMaxSettingsBytes = std::uintmax_t{1} << 20;

/// Throws astro::Error if the file does not exist or is no regular file. If only its `.part` exists, the
/// message says so.
void require_file(const std::filesystem::path& path);

/// Reads the whole file. Throws astro::Error as require_file does, or if it cannot be read or is larger than
/// `most_bytes`.
Bytes load_file(const std::filesystem::path& path, std::uintmax_t most_bytes = kMaxFileBytes);

/// The same for text. A file that is no text is refused before the rest is read, at its first NUL byte (UTF-16, a hole in a
/// sparse file) or at its first line of more than `longest_line` bytes. The default is enough for any line of a table.
inline constexpr std::size_t kLongestLine = std::size_t{1} << 20;
Bytes load_text(const std::filesystem::path& path, std::size_t longest_line = kLongestLine);

/// To be called before a file is replaced that may be a person's own. Throws astro::Error if the file at `path` is not empty
/// and does not contain `mark`. All files that this program writes there contain `mark` near their beginning; `kind` names them
/// ("report").
void require_own_kind(const std::filesystem::path& path, std::string_view mark, const std::string& kind);

/// Throws astro::Error if `path` is one of the files that are read to write it.
void require_no_input(const std::filesystem::path& path, std::initializer_list<std::filesystem::path> inputs);

/// A file that gets its name only when it is complete. Bytes go to `<path>.part`; commit() syncs them to the
/// disk and renames the file, replacing an older file of that name unless it is a recording, because a drive
/// cannot be repeated. Without commit() a `.part` that holds anything stays, so that its content can be
/// rescued, until the same path is written again. Missing folders of the path are created.
///
/// Links   a folder in the path may be a link; a `.part` that is a link is refused.
/// Errors  astro::Error naming the file and what the system said, or that there is a folder or a recording of
///         that name, or that another program is writing it.
class PartFile {
 public:
  enum class Replaces { all_but_recordings, recordings_too };
  explicit PartFile(std::filesystem::path path, Replaces replaces = Replaces::all_but_recordings);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// On return the operating system has the bytes: they survive if this process is killed, but not if the
  /// machine loses power.
  void write(ByteView bytes);
  void commit();

 private:
  void open_part();
  [[noreturn]] void fail(const std::string& what) const;  // by errno

  std::filesystem::path path_, part_;
  Descriptor descriptor_;
  bool empty_ = true;
};

}  // namespace astro
