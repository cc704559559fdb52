#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/base/temporary_folder.hpp"

/// Real programs in tests, each bounded in time.
namespace astro::support {

/// A child process whose stdout and stderr go to files, without stdin.
class Program {
 public:
  explicit Program(const std::vector<std::string>& command) {
    out_ = (folder_.path() / "out").string();
    err_ = (folder_.path() / "err").string();
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    redirect("/dev/null", O_RDONLY, 0);
    redirect(out_, O_WRONLY | O_CREAT | O_TRUNC, 1);
    redirect(err_, O_WRONLY | O_CREAT | O_TRUNC, 2);
    alarm(240);  // whatever the test does, the child ends; the timer survives exec
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  ~Program() {
    if (pid_ > 0) {
      send(SIGKILL);
      wait();
    }
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// After SIGSTOP it waits until nothing of the program runs any more: kill() returns before another processor heeds it.
  void send(int signal) const {
    kill(pid_, signal);
    siginfo_t stopped;
    if (signal == SIGSTOP) waitid(P_PID, static_cast<id_t>(pid_), &stopped, WSTOPPED | WEXITED | WNOWAIT);
  }
  pid_t pid() const { return pid_; }

  /// Exit code, or 128 + the signal that ended it.
  int wait() {
    if (pid_ > 0) reap(0);
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  }
  bool running() { return pid_ > 0 && !reap(WNOHANG); }

  std::string out() const { return text(out_); }
  std::string err() const { return text(err_); }

 private:
  /// True once the child has ended.
  bool reap(int options) {
    if (waitpid(pid_, &status_, options) != pid_) return false;
    pid_ = -1;
    return true;
  }
  static void redirect(const std::string& path, int flags, int to) {
    const int fd = open(path.c_str(), flags, 0600);
    dup2(fd, to);
    close(fd);
  }
  static std::string text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  test::TemporaryFolder folder_;
  std::string out_, err_;
  pid_t pid_ = -1;
  int status_ = 0;
};

struct Outcome {
  int code = 0;
  std::string out, err;
};

/// Runs `astrolabe` to its end.
inline Outcome astrolabe(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{ASTROLABE_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Program program(command);
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

/// Waits, without sleeping a fixed time, until `condition` holds; false after `limit`.
template <class Condition>
bool eventually(Condition condition, std::chrono::seconds limit = std::chrono::seconds(100)) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    poll(nullptr, 0, 2);
  }
  return true;
}

/// `astrolabe sim` in a folder of its own, ready when constructed.
class Simulator {
 public:
  explicit Simulator(const std::vector<std::string>& options = {"--fast"}) : program_(command(options)) {
    if (!eventually([&] {
          return std::filesystem::exists(port()) && program_.err().find('\n') != std::string::npos;
        }))
      throw std::runtime_error("the simulator does not start: " + program_.err());
  }
  std::string port() const { return (folder_.path() / "robot.pty").string(); }
  std::filesystem::path folder() const { return folder_.path(); }
  Program& program() { return program_; }

 private:
  std::vector<std::string> command(const std::vector<std::string>& options) const {
    std::vector<std::string> words{ASTROLABE_PROGRAM, "sim", "--pty", port()};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }
  test::TemporaryFolder folder_;
  Program program_;
};

/// The robot bears it if its host is silent for so long instead of 0.2 s.
inline void forgive_late_hosts(const std::string& port,
                               std::chrono::milliseconds silence = std::chrono::seconds(10)) {
  const Outcome outcome = astrolabe(
      {"params", "set", "command_timeout=" + std::to_string(silence.count()), "--yes", "--port", port});
  if (outcome.code != 0) throw std::runtime_error("the time-out cannot be set: " + outcome.err);
}

inline void forgive_late_hosts(const Simulator& simulator) { forgive_late_hosts(simulator.port()); }

/// For drives of many seconds in real time that claim nothing of time-outs: a busy machine may hold up their host for longer
/// than the 0.2 s after which a robot on a path stops by itself.
class PatientSimulator : public Simulator {
 public:
  explicit PatientSimulator(const std::vector<std::string>& options) : Simulator(options) {
    forgive_late_hosts(*this);
  }
};

}  // namespace astro::support
