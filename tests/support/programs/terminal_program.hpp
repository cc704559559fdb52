#pragma once

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

namespace astro::support {

struct TerminalKind {
  unsigned short columns = 80, rows = 24;
  const char* name = "xterm";  // what TERM says
  std::string typed_ahead{};   // keys that are pressed before the program begins
};

/// A child process with a terminal of its own, as a person would run it.
class TerminalProgram {
 public:
  explicit TerminalProgram(const std::vector<std::string>& command, TerminalKind kind = {}) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    winsize size{kind.rows, kind.columns, 0, 0};
    std::array<char, 64> name{};
    std::array<int, 2> go{};
    if (pipe2(go.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    pid_ = forkpty(&master_, name.data(), nullptr, &size);
    if (pid_ < 0) throw std::runtime_error("forkpty failed");
    if (pid_ == 0) {
      char begin = 0;
      if (read(go[0], &begin, 1) != 1) _exit(125);
      setenv("TERM", kind.name, 1);
      alarm(240);  // whatever the test does, the child ends; the timer survives exec
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    keeper_ = open(name.data(), O_RDWR | O_NOCTTY);  // the terminal outlives the child
    if (!kind.typed_ahead.empty()) type(kind.typed_ahead);
    if (write(go[1], "g", 1) != 1) throw std::runtime_error("the child cannot be started");
    for (const int end : go) close(end);
  }
  ~TerminalProgram() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    close(master_);
    close(keeper_);
  }
  TerminalProgram(const TerminalProgram&) = delete;
  TerminalProgram& operator=(const TerminalProgram&) = delete;

  void type(const std::string& keys) const {
    if (write(master_, keys.data(), keys.size()) < 0) throw std::runtime_error("the terminal is gone");
  }
  void send(int signal) const { kill(pid_, signal); }

  /// Reads until `text` has been shown since the last call that found its text; false after `limit`.
  bool shows(const std::string& text, std::chrono::seconds limit = std::chrono::seconds(100)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (true) {
      const std::size_t at = seen_.find(text, looked_at_);
      if (at != std::string::npos) {
        looked_at_ = at + text.size();
        return true;
      }
      if (std::chrono::steady_clock::now() > end) return false;
      read_some();
    }
  }

  /// Exit code, or 128 + the signal that ended it; what it showed until then is in seen().
  int wait() {
    int status = 0;
    while (waitpid(pid_, &status, WNOHANG) != pid_) read_some();
    pid_ = -1;
    while (read_some()) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  const std::string& seen() const { return seen_; }

  /// True while the terminal collects lines and echoes, as a shell expects to find it.
  bool is_cooked() const {
    termios mode{};
    tcgetattr(keeper_, &mode);
    return (mode.c_lflag & ICANON) != 0 && (mode.c_lflag & ECHO) != 0;
  }

 private:
  bool read_some() {
    pollfd ready{master_, POLLIN, 0};
    if (poll(&ready, 1, 10) <= 0 || (ready.revents & POLLIN) == 0) return false;
    std::array<char, 4096> buffer{};
    const auto size = read(master_, buffer.data(), buffer.size());
    if (size <= 0) return false;
    seen_.append(buffer.data(), static_cast<std::size_t>(size));
    return true;
  }

  int master_ = -1, keeper_ = -1;
  pid_t pid_ = -1;
  std::string seen_;
  std::size_t looked_at_ = 0;
};

}  // namespace astro::support
