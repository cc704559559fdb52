#include "host/programs/emulator/halfkay.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "host/base/error.hpp"

namespace astro::emulator {

HalfKay::HalfKay(std::filesystem::path fifo) : path_(std::move(fifo)) {
  if (mkfifo(path_.c_str(), 0600) == 0) fd_ = open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0)
    throw Error(
        fmt::format("the boot loader's '{}' cannot be made: {}", path_.string(), std::strerror(errno)));
}

HalfKay::~HalfKay() {
  close(fd_);
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

std::optional<std::string> HalfKay::receive() {
  std::array<char, 4096> bytes{};
  ssize_t count = 0;
  while ((count = read(fd_, bytes.data(), bytes.size())) > 0)
    received_.append(bytes.data(), static_cast<std::size_t>(count));
  const bool closed = count == 0;  // by the writer, or no writer has opened it yet
  if (!closed || received_.empty()) return {};
  return std::exchange(received_, {});
}

}  // namespace astro::emulator
