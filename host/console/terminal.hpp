#pragma once

#include <termios.h>

#include <chrono>
#include <string>

/// A terminal that a command takes over for a while: keys as they are pressed, and a picture redrawn in
/// place.
namespace astro::console {

/// Keys arrive one by one and are not echoed for as long as it lives. Ctrl-C still interrupts; Ctrl-Z and
/// Ctrl-\ do nothing, for they would leave a robot moving. The old mode comes back however it ends, a second
/// Ctrl-C included.
class RawTerminal {
 public:
  /// Throws astro::Error if stdin is no terminal.
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  /// What was typed since the last call; never waits.
  std::string typed();
};

struct TerminalSize {
  std::size_t columns = 80, rows = 24;
};

/// Of the terminal behind `fd`; the default where it does not say.
TerminalSize terminal_size(int fd);

/// True if `fd` is a terminal that obeys escape sequences. TERM=dumb, or none, says that it does not: it
/// would show them as they are.
bool obeys_escapes(int fd);

/// Lines redrawn in the same place on a terminal, cut to its size. What is drawn last stays. A terminal that
/// obeys no escape sequences gets one short line at a time instead, below one another.
class Picture {
 public:
  explicit Picture(int fd) : fd_(fd), redraws_(obeys_escapes(fd)) {}
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// `text`: lines, each ended by a newline. `line`: the same in one line without
  /// its newline, for terminals that obey no escape sequences; they get it once a second, and only if it has
  /// changed.
  void draw(const std::string& text, const std::string& line);

 private:
  void draw_over(const std::string& text);
  void add_line(const std::string& line);

  int fd_;
  bool redraws_;
  std::string line_;  // the last, if lines are added
  std::chrono::steady_clock::time_point line_at_{};
  std::size_t lines_ = 0;
  bool drawn_ = false;
};

/// The first `columns` characters of UTF-8 text.
std::string clipped(const std::string& line, std::size_t columns);

/// A bar from the middle outwards: `fraction` in [-1, 1], positive to the right; 2 * half + 1 characters.
std::string gauge(double fraction, int half);

}  // namespace astro::console
