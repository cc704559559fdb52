#include "host/commands/robot/loader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/system_error.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/robot/motion/drive.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

constexpr auto kUntilItSeemsLong = std::chrono::seconds(15), kUntilItIsTooLong = std::chrono::seconds(120);

constexpr std::size_t kMostWords = std::size_t{16} << 10;  // of the loader's output, in bytes

bool runnable(const fs::path& path) {
  std::error_code unreadable;
  return fs::is_regular_file(path, unreadable) && access(path.c_str(), X_OK) == 0;
}

std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string last = "it said nothing";
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  return last;
}

constexpr const char* kInterrupted =
    "interrupted: the robot waits in its boot loader for 'astrolabe flash --button'";

/// A loader that is running, with its output on a pipe; the destructor ends it.
class LoaderProcess {
 public:
  explicit LoaderProcess(std::array<std::string, 5> words) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw system_error("no pipe for the loader can be made", errno);
    std::array<char*, 6> arguments{};
    for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    const int failure = posix_spawn(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    words_ = ends[0];
    if (failure == 0) return;
    close(words_);
    if (failure == ENOEXEC || failure == EACCES)
      throw Error(fmt::format("'{}' cannot be run: is it a program?", words[0]));
    throw system_error(fmt::format("'{}' cannot be run", words[0]), failure);
  }
  ~LoaderProcess() {
    close(words_);
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);  // nothing is lost but a transfer that is given up anyway
    wait();
  }
  LoaderProcess(const LoaderProcess&) = delete;
  LoaderProcess& operator=(const LoaderProcess&) = delete;

  /// Reads its output until it closes it; returns the end of it.
  std::string listen() const {
    std::string said;
    std::vector<char> buffer(65536);  // capacity of a pipe
    const auto begun = std::chrono::steady_clock::now();
    bool warned = false;
    while (true) {
      if (!warned && std::chrono::steady_clock::now() - begun > kUntilItSeemsLong) {
        console::say("the loader waits for a Teensy: is its USB cable plugged in? (Ctrl-C ends it)");
        warned = true;
      }
      if (std::chrono::steady_clock::now() - begun > kUntilItIsTooLong)
        throw Error("the loader found no Teensy: plug in its USB cable, and flash again with --button");
      if (console::interrupted()) throw Interrupted(kInterrupted);
      pollfd state{words_, POLLIN, 0};
      if (poll(&state, 1, 50) <= 0) continue;
      const ssize_t count = read(words_, buffer.data(), buffer.size());
      if (count <= 0) return said;
      said.append(buffer.data(), static_cast<std::size_t>(count));
      if (said.size() > 2 * kMostWords) said.erase(0, said.size() - kMostWords);  // only its end is reported
    }
  }

  /// Throws Interrupted if Ctrl-C at the terminal, which reaches the loader too, has ended it.
  bool succeeded() {
    const int status = wait();
    if (WIFSIGNALED(status) && console::interrupted()) throw Interrupted(kInterrupted);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
  /// The status of waitpid; a failure if that fails.
  int wait() {
    int status = 0;
    pid_t ended = -1;
    do ended = waitpid(pid_, &status, 0);
    while (ended < 0 && errno == EINTR);
    const bool told = ended == pid_;
    pid_ = -1;
    return told ? status : SIGKILL;
  }

  pid_t pid_ = -1;
  int words_ = -1;
};

}  // namespace

fs::path find_loader() {
  if (const char* named = std::getenv("ASTROLABE_LOADER"); named != nullptr) {
    if (runnable(named)) return named;
    throw Error(fmt::format("ASTROLABE_LOADER names '{}', which is no program: unset it or name one", named));
  }
  const char* folders = std::getenv("PATH");
  std::istringstream path(folders != nullptr ? folders : "");
  for (std::string folder; std::getline(path, folder, ':');)
    if (runnable(fs::path(folder) / "teensy_loader_cli")) return fs::path(folder) / "teensy_loader_cli";
  throw Error("teensy_loader_cli is not installed: apt install teensy-loader-cli");
}

void run_loader(const fs::path& loader, const fs::path& hex) {
  LoaderProcess running({loader.string(), "--mcu=TEENSY40", "-w", "-v", hex.string()});
  const std::string said = running.listen();
  if (!running.succeeded())
    throw Error(fmt::format("the loader failed: {} (press the robot's button and flash again with --button)",
                            last_line(said)));
}

}  // namespace astro::commands
