#pragma once

#include <termios.h>

#include <string>

/// A terminal that a command takes over for a while: keys as they are pressed, and a picture redrawn in
/// place.
namespace astro::cli {

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

/// Lines redrawn in the same place on a terminal, cut to its size. What is drawn last stays.
class Picture {
 public:
  explicit Picture(int fd) : fd_(fd) {}
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// Lines, each ended by a newline.
  void draw(const std::string& picture);

 private:
  int fd_;
  std::size_t lines_ = 0;
  bool drawn_ = false;
};

/// The first `columns` characters of UTF-8 text.
std::string clipped(const std::string& line, std::size_t columns);

/// A bar from the middle outwards: `fraction` in [-1, 1], positive to the right; 2 * half + 1 characters.
std::string gauge(double fraction, int half);

}  // namespace astro::cli
