#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "tests/support/links/pty.hpp"

namespace astro::test {

/// A cable between a robot's pty and a pty of its own, which a link in the file system names: it can be pulled out and put in
/// again while the robot goes on. A process of its own carries the bytes, so that nobody in the test has to.
class PtyCable {
 public:
  PtyCable(std::string robot, std::filesystem::path port) : robot_(std::move(robot)), port_(std::move(port)) {
    plug_in();
  }
  PtyCable(const PtyCable&) = delete;
  PtyCable& operator=(const PtyCable&) = delete;
  ~PtyCable() { pull(); }

  void plug_in() {
    Pty pty;
    std::filesystem::create_symlink(pty.path(), port_);
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("no process for the cable");
    if (process_ == 0) carry(pty.master());
  }
  void pull() {
    if (process_ == 0) return;
    std::filesystem::remove(port_);
    kill(process_, SIGKILL);
    waitpid(std::exchange(process_, 0), nullptr, 0);
  }

 private:
  [[noreturn]] void carry(int host) const {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // whatever becomes of the test
    const int robot = open(robot_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (robot < 0) _exit(1);
    termios mode{};
    tcgetattr(robot, &mode);
    cfmakeraw(&mode);
    tcsetattr(robot, TCSANOW, &mode);
    while (true) {
      std::array<pollfd, 2> ready{pollfd{host, POLLIN, 0}, pollfd{robot, POLLIN, 0}};
      poll(ready.data(), ready.size(), -1);
      if ((ready[0].revents & (POLLIN | POLLHUP)) != 0 && !pass(host, robot))
        poll(nullptr, 0, 1);  // nobody has the port open
      if ((ready[1].revents & POLLIN) != 0) pass(robot, host);
      if ((ready[1].revents & POLLHUP) != 0) _exit(0);
    }
  }
  static bool pass(int from, int to) {
    std::array<char, 4096> buffer{};
    const ssize_t size = read(from, buffer.data(), buffer.size());
    return size > 0 && write(to, buffer.data(), static_cast<std::size_t>(size)) == size;
  }

  std::string robot_;
  std::filesystem::path port_;
  pid_t process_ = 0;
};

}  // namespace astro::test
