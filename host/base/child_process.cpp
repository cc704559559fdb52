#include "host/base/child_process.hpp"

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

namespace astro {
namespace {

struct ChildPipe {
  Descriptor ours, childs;
};

/// Only this program's end is non-blocking, because the other program need not expect that of its output.
ChildPipe new_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw system_error("no pipe to another program can be made", errno);
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

bool comes_later(ssize_t count) { return count < 0 && (errno == EAGAIN || errno == EINTR); }

}  // namespace

ChildProcess::~ChildProcess() {
  if (pid_ > 0) finish(std::chrono::milliseconds::zero());
}

int ChildProcess::start(std::vector<std::string> words, Output output, Line line) {
  ChildPipe lines = new_pipe();
  ChildPipe bytes = output == Output::bytes ? new_pipe() : ChildPipe();
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, (bytes.childs ? bytes : lines).childs.get(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, lines.childs.get(), STDERR_FILENO);
  pid_t started = -1;
  const int failure = posix_spawnp(&started, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return failure;
  pid_ = started;
  line_ = std::move(line);
  output_ = std::move(bytes.ours);
  lines_ = std::move(lines.ours);
  return 0;
}

void ChildProcess::end_line() {
  if (!unfinished_.empty()) line_(unfinished_);
  unfinished_.clear();
}

void ChildProcess::take_lines() {
  constexpr std::size_t kMostOfLine = 4096;
  std::array<char, 65536> buffer;  // capacity of a pipe
  const ssize_t count = ::read(lines_.get(), buffer.data(), buffer.size());
  if (comes_later(count)) return;
  if (count <= 0) {
    lines_.reset();
    return end_line();
  }
  for (const char c : std::string_view(buffer.data(), static_cast<std::size_t>(count))) {
    if (c == '\n' || c == '\r')
      end_line();
    else if (unfinished_.size() < kMostOfLine)
      unfinished_ += c;
  }
}

bool ChildProcess::wait(std::chrono::milliseconds patience) {
  std::array<pollfd, 2> states{pollfd{lines_.get(), POLLIN, 0}, pollfd{output_.get(), POLLIN, 0}};
  const int ready = poll(states.data(), states.size(), static_cast<int>(patience.count()));
  if (ready < 0 && errno != EINTR)
    throw Error("another program's words cannot be waited for: too little memory");
  if (ready > 0 && states[0].revents != 0) take_lines();
  return ready != 0;
}

std::size_t ChildProcess::read(std::span<std::uint8_t> bytes) {
  const ssize_t count = ::read(output_.get(), bytes.data(), bytes.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (!comes_later(count)) output_.reset();
  return 0;
}

void ChildProcess::terminate() const {
  if (pid_ > 0) kill(pid_, SIGTERM);
}

std::optional<int> ChildProcess::finish(std::chrono::milliseconds patience) {
  constexpr int kLook_ms = 2;
  int status = 0;
  pid_t ended = 0;
  for (auto left_ms = patience.count(); left_ms > 0 && ended == 0; left_ms -= kLook_ms) {
    ended = waitpid(pid_, &status, WNOHANG);
    if (ended == 0) poll(nullptr, 0, kLook_ms);
  }
  if (ended == 0) kill(pid_, SIGKILL);
  while (ended == 0 || (ended < 0 && errno == EINTR)) ended = waitpid(pid_, &status, 0);
  const bool known = ended == std::exchange(pid_, -1);
  return known && WIFEXITED(status) ? std::optional(WEXITSTATUS(status)) : std::nullopt;
}

}  // namespace astro
