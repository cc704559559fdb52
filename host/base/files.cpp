#include "host/base/files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "host/base/byte_source.hpp"
#include "host/base/error.hpp"
#include "host/base/file_problem.hpp"
#include "host/base/system_error.hpp"

namespace astro {
namespace fs = std::filesystem;
namespace {

fs::path part_of(fs::path path) { return path += ".part"; }

bool is_recording(const fs::path& path) {
  constexpr char kMagic[] = {'\x89', 'M', 'C', 'A', 'P'};
  char start[sizeof kMagic] = {};
  std::ifstream file(path, std::ios::binary);
  return file.read(start, sizeof start) && std::equal(std::begin(start), std::end(start), kMagic);
}

Error too_large(const fs::path& path, std::uintmax_t size, std::uintmax_t most_bytes) {
  if (most_bytes == kMaxFileBytes)
    return Error(path.string() + " is larger than 4 GiB: split it into shorter runs", FileProblem::too_large,
                 {path.string(), std::to_string(size), std::to_string(most_bytes)});
  return Error(path.string() + " has " + std::to_string(size) +
                   " bytes, and no file of its kind has more than " + std::to_string(most_bytes) +
                   ": name the right file",
               FileProblem::too_large, {path.string(), std::to_string(size), std::to_string(most_bytes)});
}

/// Syncs the folder, so that the new name survives a power cut, too. Some file systems cannot do that; the
/// failure is ignored.
void sync_folder(const fs::path& folder) {
  const Descriptor opened(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened) ::fsync(opened.get());
}

/// Loads the whole file. `judge` sees each block, and what was read before it, before the block is added.
template <class Judge>
Bytes loaded(const fs::path& path, std::uintmax_t most_bytes, const Judge& judge) {
  constexpr std::uint64_t kBlock = std::uint64_t{1} << 20;
  FileSource file(path);
  if (file.size() > most_bytes) throw too_large(path, file.size(), most_bytes);
  Bytes bytes;
  while (bytes.size() < file.size()) {
    const ByteView block =
        file.read(bytes.size(), static_cast<std::size_t>(std::min(file.size() - bytes.size(), kBlock)));
    judge(block, bytes);
    if (bytes.empty()) bytes.reserve(static_cast<std::size_t>(file.size()));  // `judge` accepted its start
    append(bytes, block);
  }
  return bytes;
}

}  // namespace

void require_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status))
    throw Error("cannot read " + path.string() + ": " + error.message(), FileProblem::unreadable,
                {path.string(), error.message()});
  if (!fs::exists(status)) {
    if (fs::exists(part_of(path), error)) {
      throw Error(path.string() + " was never finished: what was recorded of it is in " +
                      part_of(path).string() + "; rename that file to use it, or record the run again",
                  FileProblem::unfinished, {path.string()});
    }
    throw Error(path.string() + " does not exist: check the path", FileProblem::missing, {path.string()});
  }
  if (fs::is_directory(status))
    throw Error(path.string() + " is a folder: name a file in it", FileProblem::is_folder, {path.string()});
  if (!fs::is_regular_file(status))
    throw Error(path.string() + " is a device or a pipe: name a file", FileProblem::is_device_or_pipe,
                {path.string()});
}

Bytes load_file(const fs::path& path, std::uintmax_t most_bytes) {
  return loaded(path, most_bytes, [](ByteView, const Bytes&) {});
}

Bytes load_text(const fs::path& path, std::size_t longest_line) {
  std::size_t line_begin = 0;  // of the last line by now
  return loaded(path, kMaxFileBytes, [&](ByteView block, const Bytes& before) {
    const std::string_view text = as_text(block);
    if (const std::size_t zero = text.find('\0'); zero != text.npos)
      throw Error(path.string() + " is not plain text: byte " + std::to_string(before.size() + zero + 1) +
                      " is zero: save the table as comma separated UTF-8",
                  FileProblem::not_plain_text, {path.string(), std::to_string(before.size() + zero + 1)});
    if (const std::size_t end = text.find_last_of("\r\n"); end != text.npos)
      line_begin = before.size() + end + 1;
    if (before.size() + block.size() - line_begin > longest_line)
      throw Error(path.string() + " is no table: from byte " + std::to_string(line_begin + 1) +
                      " on, a line has more than " + std::to_string(longest_line) +
                      " bytes: save the table as comma separated UTF-8",
                  FileProblem::line_too_long, {path.string(), std::to_string(line_begin + 1)});
  });
}

void require_own_kind(const fs::path& path, std::string_view mark, const std::string& kind) {
  constexpr std::size_t kBeginning = 65536;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored) || fs::file_size(path, ignored) == 0) return;
  std::string beginning(kBeginning, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  if (beginning.find(mark) == std::string::npos)
    throw Error("'" + path.string() + "' exists and is no " + kind +
                    " of this program, as what would replace it is: remove it or name another file",
                FileProblem::of_other_kind, {path.string(), kind});
}

void require_no_input(const fs::path& path, std::initializer_list<fs::path> inputs) {
  std::error_code ignored;
  for (const fs::path& input : inputs)
    if (fs::equivalent(path, input, ignored))
      throw Error("'" + path.string() + "' is read, and would be overwritten: name another file",
                  FileProblem::is_input, {path.string()});
}

PartFile::PartFile(fs::path path, Replaces replaces) : path_(std::move(path)), part_(part_of(path_)) {
  std::error_code ignored, error;
  if (fs::is_directory(path_, ignored))
    throw Error("'" + path_.string() + "' is a folder: name a file in it", FileProblem::is_folder,
                {path_.string()});
  if (fs::exists(path_, ignored) && !fs::is_regular_file(path_, ignored))
    throw Error("'" + path_.string() + "' is a device or a pipe: name a file", FileProblem::is_device_or_pipe,
                {path_.string()});
  const auto is_kept = [&] { return replaces != Replaces::recordings_too && is_recording(path_); };
  const Remark kept{"'" + path_.string() + "' is a recording, and nothing replaces one: name another file",
                    FileProblem::is_recording,
                    {path_.string()}};
  if (is_kept()) throw Error(kept);
  if (path_.has_parent_path()) fs::create_directories(path_.parent_path(), error);
  if (error) {
    throw Error("cannot make the folder " + path_.parent_path().string() + ": " + error.message(),
                FileProblem::folder_not_made, {path_.parent_path().string()});
  }
  open_part();
  if (!is_kept()) return;
  ::unlink(part_.c_str());  // another program has made it before this one held the lock
  throw Error(kept);
}

/// Does not follow a link: a person who may write into the folder must not choose which file is emptied. The
/// lock is held until the file has its name, so that two programs never write one file.
void PartFile::open_part() {
  constexpr int kTries = 100;
  for (int tries = 1;; ++tries) {
    descriptor_.reset(::open(part_.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666));
    if (!descriptor_) fail("create");
    struct stat opened {
    }, named{};
    if (::fstat(descriptor_.get(), &opened) == 0 && !S_ISREG(opened.st_mode))
      throw Error(
          part_.string() + " is no file, so nothing can be recorded there: remove it or name another file",
          FileProblem::is_device_or_pipe, {part_.string()});
    if (::flock(descriptor_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw Error(part_.string() + " is being written by another program: wait for it or name another file",
                  FileProblem::in_use, {part_.string()});
    // Another program may have given the file its name between open and flock: it is no longer ours to empty.
    if (::lstat(part_.c_str(), &named) == 0 && named.st_ino == opened.st_ino && named.st_dev == opened.st_dev)
      break;
    if (tries == kTries) throw Error(part_.string() + " changes again and again: choose another folder");
    descriptor_.reset();
  }
  if (::ftruncate(descriptor_.get(), 0) != 0) fail("empty");
}

PartFile::~PartFile() {
  // Unlinked while it is locked, because afterwards the name may be another program's.
  if (descriptor_ && empty_) ::unlink(part_.c_str());
}

void PartFile::fail(const std::string& what) const {
  if (errno == ELOOP)
    throw Error(
        part_.string() + " is a link, and nothing is written through one: remove it or name another file",
        FileProblem::is_link, {part_.string()});
  throw system_error("cannot " + what + " " + part_.string(), errno,
                     "; check the disk or choose another folder", FileProblem::unwritable, {part_.string()});
}

void PartFile::write(ByteView bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write");
    empty_ = false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void PartFile::commit() {
  if (::fsync(descriptor_.get()) != 0) fail("bring to the disk");
  std::error_code error;
  fs::rename(part_, path_, error);
  if (error)
    throw Error("cannot rename " + part_.string() + " to " + path_.string() + ": " + error.message());
  if (::close(descriptor_.release()) != 0) fail("close");
  sync_folder(path_.parent_path());
}

}  // namespace astro
