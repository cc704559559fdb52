#include "host/base/byte_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "host/base/file_problem.hpp"
#include "host/base/files.hpp"
#include "host/base/system_error.hpp"

namespace astro {
namespace {

constexpr std::size_t kWindowBytes = std::size_t{1} << 20;

std::string cannot_read(const std::filesystem::path& path) { return "cannot read " + path.string(); }

[[noreturn]] void fail(const std::filesystem::path& path, int code) {
  throw system_error(cannot_read(path), code, ": check its permissions and the disk", FileProblem::unreadable,
                     {path.string(), system_reason(code)});
}

}  // namespace

FileSource::FileSource(std::filesystem::path path) : path_(std::move(path)) {
  require_file(path_);
  // O_NONBLOCK: opening a pipe that nobody writes to must not wait.
  descriptor_.reset(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!descriptor_) fail(path_, errno);
  struct stat status {};
  if (::fstat(descriptor_.get(), &status) != 0 || !S_ISREG(status.st_mode))
    throw Error(cannot_read(path_) + ": it is not a regular file: check the path",
                FileProblem::is_device_or_pipe, {path_.string()});
  size_ = static_cast<std::uint64_t>(status.st_size);
}

ByteView FileSource::read(std::uint64_t offset, std::size_t count) {
  if (offset < window_start_ || offset + count > window_start_ + window_.size()) {
    const std::uint64_t most = std::max(count, kWindowBytes);
    window_.resize(static_cast<std::size_t>(std::min(most, size_ - offset)));
    window_start_ = offset;
    for (std::size_t done = 0; done < window_.size();) {
      const ssize_t got = ::pread(descriptor_.get(), window_.data() + done, window_.size() - done,
                                  static_cast<off_t>(offset + done));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) {
        window_.clear();
        if (got < 0) fail(path_, errno);
        throw Error(cannot_read(path_) + ": it became shorter: check the path");
      }
      done += static_cast<std::size_t>(got);
    }
  }
  return ByteView(window_).subspan(static_cast<std::size_t>(offset - window_start_), count);
}

}  // namespace astro
