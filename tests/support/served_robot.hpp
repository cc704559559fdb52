#pragma once

#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <thread>

#include "tests/support/fake_robot.hpp"

namespace astro::test {

/// A FakeRobot on a thread of its own that answers on a file descriptor: the master side of a pty, or a
/// socket. Ends with the object or with the other side; does not close the descriptor. No clock: it only
/// answers.
class ServedRobot {
 public:
  explicit ServedRobot(int descriptor) : thread_([this, descriptor] { serve(descriptor); }) {}
  ServedRobot(const ServedRobot&) = delete;
  ServedRobot& operator=(const ServedRobot&) = delete;
  ~ServedRobot() {
    ended_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> ended_ = false;
  FakeRobot robot_;
  std::thread thread_;

  void serve(int descriptor) {
    std::array<std::uint8_t, 512> buffer;
    while (!ended_) {
      pollfd ready{descriptor, POLLIN, 0};
      if (::poll(&ready, 1, 5) <= 0 || (ready.revents & POLLIN) == 0) continue;
      const auto size = ::read(descriptor, buffer.data(), buffer.size());
      if (size <= 0) continue;
      for (const auto& frame : robot_.receive({buffer.data(), static_cast<std::size_t>(size)})) {
        if (::write(descriptor, frame.data(), frame.size()) < 0) return;
      }
    }
  }
};

}  // namespace astro::test
