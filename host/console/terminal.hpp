#pragma once

#include <termios.h>

#include <chrono>
#include <string>

/// A terminal that a command takes over for a while: it reads keys as they are pressed, and redraws a picture
/// in place.
namespace astro::console {

/// For as long as the object lives, keys arrive one by one and are not echoed. Ctrl-C still interrupts;
/// Ctrl-Z and Ctrl-\ do nothing, because they would leave a robot moving. The old mode is restored however
/// the program ends, also by a second Ctrl-C.
class RawTerminal {
 public:
  /// Throws astro::Error if stdin is no terminal.
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  /// Returns what was typed since the last call; never waits.
  std::string typed();
};

struct TerminalSize {
  std::size_t columns = 80, rows = 24;
};

/// Size of the terminal behind `fd`; the default if it reports none.
TerminalSize terminal_size(int fd);

/// True if `fd` is a terminal that obeys escape sequences. With TERM=dumb or without TERM it would print them
/// as text.
bool obeys_escapes(int fd);

/// Lines that are redrawn in the same place on a terminal, cut to its size. The last picture stays. A
/// terminal without escape sequences gets one short line at a time instead, each below the last.
class Picture {
 public:
  explicit Picture(int fd) : fd_(fd), redraws_(obeys_escapes(fd)) {}
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// `text`: lines, each ended by a newline. `line`: the same in one line without a newline, for terminals
  /// without escape sequences; it is printed at most once a second, and only if it has changed.
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

/// A bar that grows from its middle: `fraction` in [-1, 1], positive to the right; 2 * half + 1 characters.
std::string gauge(double fraction, int half);

}  // namespace astro::console
