#pragma once

#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "tests/support/base/temporary_folder.hpp"

namespace astro::support {

/// A program in a terminal of 80 columns that tmux keeps, with what a person sees of it: lines that wrap are broken where the
/// terminal breaks them.
class TmuxProgram {
 public:
  explicit TmuxProgram(const std::string& command) {
    tmux("-f /dev/null new-session -d -x 80 -y 50 'exec " + command +
         "' \\; set -g remain-on-exit on \\; set -g history-limit 9999");
  }
  ~TmuxProgram() { tmux("kill-server"); }
  TmuxProgram(const TmuxProgram&) = delete;
  TmuxProgram& operator=(const TmuxProgram&) = delete;

  /// A line, and Enter.
  void type(const std::string& line) const {
    if (!line.empty()) tmux("send-keys -l -- '" + line + "'");
    tmux("send-keys Enter");
  }

  /// A key by tmux's name for it, as C-c.
  void key(const std::string& name) const { tmux("send-keys " + name); }

  /// All that was shown, from the first line on.
  std::string seen() const { return tmux("capture-pane -p -S -"); }

  /// Waits until `text` has been shown behind what was found last; false after `limit`. `meanwhile` is called again and again while it waits.
  bool shows(
      const std::string& text, const std::function<void()>& meanwhile = [] {},
      std::chrono::seconds limit = std::chrono::seconds(100)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (true) {
      const std::string all = seen();
      if (const std::size_t at = all.find(text, looked_at_); at != std::string::npos) {
        looked_at_ = at + text.size();
        return true;
      }
      if (std::chrono::steady_clock::now() > end) return false;
      meanwhile();
      poll(nullptr, 0, 10);
    }
  }

  /// The exit code, once it has ended; -1 after `limit`.
  int wait(std::chrono::seconds limit = std::chrono::seconds(100)) const {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (std::chrono::steady_clock::now() < end) {
      const std::string state = tmux("display -p '#{pane_dead} #{pane_dead_status}'");
      if (state.starts_with("1 ")) return std::stoi(state.substr(2));
      poll(nullptr, 0, 10);
    }
    return -1;
  }

 private:
  std::string tmux(const std::string& words) const {
    const std::string command = "tmux -u -S " + (folder_.path() / "tmux").string() + ' ' + words + " 2>&1";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    if (!pipe) throw std::runtime_error("tmux cannot be run");
    std::string text;
    std::array<char, 4096> buffer{};
    while (const std::size_t size = fread(buffer.data(), 1, buffer.size(), pipe.get()))
      text.append(buffer.data(), size);
    return text;
  }

  test::TemporaryFolder folder_;
  std::size_t looked_at_ = 0;
};

}  // namespace astro::support
