#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

/// A peer (tests/support/ros2/peers) as a child process: lines to it, lines from it.
namespace astro::support {

enum class PeerKind { fast, cyclone };

/// "" if this build has none, because Debian's cyclonedds-dev was not there when it was configured.
inline std::string path_of(PeerKind kind) {
  if (kind == PeerKind::fast) return ASTRO_FAST_PEER;
#ifdef ASTRO_CYCLONE_PEER
  return ASTRO_CYCLONE_PEER;
#else
  return "";
#endif
}

class PeerProgram {
 public:
  /// `options`: "humble" or nothing.
  PeerProgram(PeerKind kind, int domain, const std::string& options = "") {
    const std::string path = path_of(kind), number = std::to_string(domain);
    int to[2], from[2];
    if (pipe2(to, O_CLOEXEC) != 0 || pipe2(from, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0) {
      dup2(to[0], STDIN_FILENO);
      dup2(from[1], STDOUT_FILENO);
      alarm(240);  // whatever the test does, the child ends; the timer survives exec
      execl(path.c_str(), path.c_str(), number.c_str(), options.c_str(), nullptr);
      _exit(127);
    }
    close(to[0]);
    close(from[1]);
    to_ = to[1];
    from_ = from[0];
    fcntl(from_, F_SETFL, O_NONBLOCK);
  }
  ~PeerProgram() {
    close(to_);  // it ends by itself
    close(from_);
    for (int i = 0; i < 5000 && waitpid(pid_, nullptr, WNOHANG) == 0; ++i) ::poll(nullptr, 0, 1);
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  PeerProgram(const PeerProgram&) = delete;
  PeerProgram& operator=(const PeerProgram&) = delete;

  pid_t pid() const { return pid_; }

  void say(const std::string& line) {
    const std::string text = line + '\n';
    if (write(to_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      throw std::runtime_error("the peer does not listen");
  }

  /// All lines that have come so far.
  const std::vector<std::string>& lines() {
    std::array<char, 65536> buffer;
    for (ssize_t size = 0; (size = read(from_, buffer.data(), buffer.size())) > 0;)
      text_.append(buffer.data(), static_cast<std::size_t>(size));
    for (std::size_t end = 0; (end = text_.find('\n')) != std::string::npos; text_.erase(0, end + 1))
      lines_.push_back(text_.substr(0, end));
    return lines_;
  }

  /// Those that begin so.
  std::vector<std::string> lines(const std::string& beginning) {
    std::vector<std::string> found;
    for (const std::string& line : lines())
      if (line.starts_with(beginning)) found.push_back(line);
    return found;
  }

 private:
  pid_t pid_ = -1;
  int to_ = -1, from_ = -1;
  std::string text_;
  std::vector<std::string> lines_;
};

/// The number behind " key=" in a line, NaN if there is none.
inline double number_in(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(' ' + key + '=');
  return at == std::string::npos ? std::numeric_limits<double>::quiet_NaN()
                                 : std::stod(line.substr(at + key.size() + 2));
}

/// The word behind " key=".
inline std::string word_in(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(' ' + key + '=');
  if (at == std::string::npos) return "";
  const std::size_t begin = at + key.size() + 2;
  return line.substr(begin, line.find_first_of(" ]", begin) - begin);
}

}  // namespace astro::support
