#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "host/base/bytes.hpp"
#include "host/base/descriptor.hpp"
#include "host/base/error.hpp"

namespace astro {

/// What is wrong with a file or a folder. Values: its path; then of too_large its size and the limit, of
/// not_plain_text the first byte that is zero and of line_too_long the first byte of the line, both counted
/// from 1, of unreadable what the system says, of of_other_kind the kind that it should have.
enum class FileProblem {
  missing,
  unfinished,
  unreadable,
  unwritable,
  is_folder,
  is_device_or_pipe,
  is_link,
  is_recording,
  is_input,
  of_other_kind,
  too_large,
  not_plain_text,
  line_too_long,
  in_use,
  folder_not_made,
  folder_in_use
};

/// The largest file that is read as a whole. What holds a few settings is limited to far less.
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{4} << 30;
inline constexpr std::uintmax_t kMaxSettingsBytes = std::uintmax_t{1} << 20;

/// Throws astro::Error if the file does not exist, and says if its `.part` does, or if it is no regular file.
void require_file(const std::filesystem::path& path);

/// Reads the whole file. Throws astro::Error as require_file does, or if it cannot be read or is larger than
/// `most_bytes`.
Bytes load_file(const std::filesystem::path& path, std::uintmax_t most_bytes = kMaxFileBytes);

/// The same of text. What is none is refused where that shows first, before the rest is read: at a NUL byte (UTF-16, a hole in a
/// sparse file), or in a line of more than kLongestLine bytes. `longest_line`: other than that of a table.
inline constexpr std::size_t kLongestLine = std::size_t{1} << 20;
Bytes load_text(const std::filesystem::path& path, std::size_t longest_line = kLongestLine);

/// Before a file is replaced that may be a person's own. Throws astro::Error if there is a file at `path` that is not empty
/// and does not contain `mark`, which all files contain, near their beginning, that this program writes there; `kind` names
/// them ("report").
void require_own_kind(const std::filesystem::path& path, std::string_view mark, const std::string& kind);

/// Throws astro::Error if `path` is one of the files that are read to write it.
void require_no_input(const std::filesystem::path& path, std::initializer_list<std::filesystem::path> inputs);

/// A file that gets its name only when it is complete. Bytes go to `<path>.part`; commit() syncs them to the
/// disk and renames the file, replacing an older file of that name unless it is a recording, because a drive
/// cannot be repeated. Without commit() a `.part` that holds anything stays, so that its content can be
/// rescued, until the same path is written again. Missing folders of the path are created.
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
