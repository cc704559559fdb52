#pragma once

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "tests/support/links/fake_robot.hpp"

namespace astro::test {

/// A FakeRobot in a process of its own that answers on a file descriptor: the master side of a pty, or a
/// socket. Ends with the object or with the other side; does not close the descriptor of this process. No
/// clock: it only answers.
///
/// A process and not a thread, because the tests fork programs that hold a port, and whatever a thread of
/// the parent holds at that moment (in the sanitizer's allocator, for one) stays locked in the child.
class ServedRobot {
 public:
  explicit ServedRobot(int descriptor) : ServedRobot(descriptor, false) {}

  /// Answers the first program that connects to the socket `listener`.
  static ServedRobot accepting(int listener) { return ServedRobot(listener, true); }

  ServedRobot(const ServedRobot&) = delete;
  ServedRobot& operator=(const ServedRobot&) = delete;
  ~ServedRobot() { end(); }

  void end() {
    if (process_ == 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(std::exchange(process_, 0), nullptr, 0);
  }

 private:
  ServedRobot(int descriptor, bool listens) : process_(::fork()) {
    if (process_ < 0) throw std::runtime_error("no process for the robot");
    if (process_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // whatever becomes of the test
    serve(listens ? ::accept(descriptor, nullptr, nullptr) : descriptor);
    ::_exit(0);
  }

  static void serve(int descriptor) {
    FakeRobot robot;
    std::array<std::uint8_t, 512> buffer;
    while (true) {
      pollfd ready{descriptor, POLLIN, 0};
      ::poll(&ready, 1, -1);
      const auto size = ::read(descriptor, buffer.data(), buffer.size());
      if (size == 0) return;
      if (size < 0) {  // nobody has the other side of the pty open: poll() does not wait for that
        ::usleep(1000);
        continue;
      }
      for (const auto& frame : robot.receive({buffer.data(), static_cast<std::size_t>(size)}))
        if (::write(descriptor, frame.data(), frame.size()) < 0) return;
    }
  }

  pid_t process_;
};

}  // namespace astro::test
