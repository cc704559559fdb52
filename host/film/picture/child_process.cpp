#include "host/film/picture/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/system_error.hpp"

namespace astro::film {
namespace {

constexpr std::size_t kLongestLine = 4096;

void close_once(int& descriptor) {
  if (descriptor >= 0) close(std::exchange(descriptor, -1));
}

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw system_error("no pipe to another program can be made", errno);
  }
  ~Pipe() {
    for (int& end : ends) close_once(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
};

}  // namespace

ChildProcess::ChildProcess(std::vector<std::string> words, Line line, std::chrono::milliseconds patience)
    : name_(words.at(0)), line_(std::move(line)), patience_(patience) {
  Pipe output, errors;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.ends[1], STDERR_FILENO);
  const int failure = posix_spawnp(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == 0) {
    output_ = std::exchange(output.ends[0], -1);
    words_ = std::exchange(errors.ends[0], -1);
    return;
  }
  pid_ = -1;
  const std::string reader = "the program '" + name_ + "', which reads films, ";
  constexpr const char* kInstall = ": install ffmpeg ('apt install ffmpeg'), which has it";
  if (failure == ENOENT) throw Error(reader + "is not installed" + kInstall);
  throw system_error(reader + "cannot be started", failure, kInstall);
}

ChildProcess::~ChildProcess() {
  close_once(output_);
  close_once(words_);
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  wait();
}

/// A program that has closed both streams may still not end; after the deadline it is ended.
int ChildProcess::wait() {
  constexpr int kLook_ms = 2;
  int status = 0;
  pid_t ended = 0;
  for (auto left_ms = patience_.count(); left_ms > 0 && ended == 0; left_ms -= kLook_ms) {
    ended = waitpid(pid_, &status, WNOHANG);
    if (ended == 0) poll(nullptr, 0, kLook_ms);
  }
  if (ended == 0) kill(pid_, SIGKILL);
  while (ended == 0 || (ended < 0 && errno == EINTR)) ended = waitpid(pid_, &status, 0);
  const bool known = ended == std::exchange(pid_, -1);
  return known ? status : SIGKILL;
}

void ChildProcess::end_words() {
  close_once(words_);
  if (!unfinished_.empty()) line_(unfinished_);
  unfinished_.clear();
}

void ChildProcess::take_words() {
  std::array<char, 4096> buffer;
  const ssize_t count = ::read(words_, buffer.data(), buffer.size());
  if (count < 0 && errno == EINTR) return;
  if (count <= 0) return end_words();
  for (const char c : std::string_view(buffer.data(), static_cast<std::size_t>(count))) {
    if (c != '\n' && c != '\r') {
      if (unfinished_.size() < kLongestLine) unfinished_ += c;
      continue;
    }
    if (!unfinished_.empty()) line_(unfinished_);
    unfinished_.clear();
  }
}

void ChildProcess::fail_silent() const {
  throw Error("the program '" + name_ + "', which reads films, has neither said anything nor ended for " +
                  std::to_string(patience_.count()) +
                  " ms: name the film that the phone recorded (MP4 or MOV)",
              ChildProblem::silent, {name_, std::to_string(patience_.count())});
}

void ChildProcess::wait_for_streams() {
  while (true) {
    std::array<pollfd, 2> states{pollfd{words_, POLLIN, 0}, pollfd{output_, POLLIN, 0}};
    const int ready = poll(states.data(), states.size(), static_cast<int>(patience_.count()));
    if (ready < 0) {
      if (errno == EINTR) continue;
      throw Error("another program's words cannot be waited for: too little memory");
    }
    if (ready == 0) fail_silent();
    if (states[0].revents != 0) take_words();
    if (states[1].revents != 0 || output_ < 0) return;
  }
}

std::size_t ChildProcess::read(std::span<std::uint8_t> bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size() && output_ >= 0) {
    wait_for_streams();
    const ssize_t count = ::read(output_, bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) close_once(output_);
    if (count > 0) filled += static_cast<std::size_t>(count);
  }
  return filled;
}

bool ChildProcess::finish() {
  std::array<std::uint8_t, 4096> rest;
  while (read(rest) == rest.size()) continue;
  while (words_ >= 0) wait_for_streams();
  const int status = wait();
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace astro::film
