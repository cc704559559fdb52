#include "host/truth/live/scanner_port.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "host/base/error.hpp"
#include "host/robot/port/serial_port.hpp"

namespace astro::truth {
namespace {

using namespace std::chrono_literals;
using std::chrono::microseconds;

constexpr microseconds kWriteTimeout = 1s;

}  // namespace

void ScannerPort::open(unsigned baud) {
  port_ = Descriptor();  // its lock is in the way of opening it again
  port_ = robot::open_serial_port(path_, baud);
}

void ScannerPort::fail_gone() const {
  throw Error("the laser scanner at " + path_ + " is gone: was it unplugged, or has its simulator ended?",
              rplidar::ScannerProblem::unplugged, {path_});
}

bool ScannerPort::wait_for(short events, microseconds timeout) const {
  pollfd state{port_.get(), events, 0};
  const timespec limit{static_cast<time_t>(timeout / 1s), static_cast<long>((timeout % 1s) / 1us * 1000)};
  if (ppoll(&state, 1, &limit, nullptr) <= 0) return false;
  if ((state.revents & events) == 0) fail_gone();  // a hang-up and nothing left to read
  return true;
}

void ScannerPort::write(ByteView bytes) {
  const microseconds deadline = now() + kWriteTimeout;
  while (!bytes.empty()) {
    const ssize_t count = ::write(port_.get(), bytes.data(), bytes.size());
    if (count < 0 && errno != EAGAIN && errno != EINTR) fail_gone();
    if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
    if (count <= 0 && (now() >= deadline || !wait_for(POLLOUT, deadline - now()))) fail_gone();
  }
}

std::size_t ScannerPort::read(std::span<std::uint8_t> into, microseconds timeout) {
  if (!wait_for(POLLIN, std::max(timeout, 0us))) return 0;
  const ssize_t count = ::read(port_.get(), into.data(), into.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  fail_gone();
}

void ScannerPort::run_motor(bool on) {
  const int line = TIOCM_DTR;
  ioctl(port_.get(), on ? TIOCMBIC : TIOCMBIS, &line);
}

microseconds ScannerPort::now() const {
  return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
}

}  // namespace astro::truth
