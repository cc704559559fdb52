#include "host/console/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "host/base/error.hpp"
#include "host/base/text/columns.hpp"
#include "host/base/text/plain_text.hpp"
#include "host/console/interrupt.hpp"

namespace astro::console {
namespace {

constexpr auto kBetweenLines = std::chrono::seconds(1);

termios before{};  // global, because a signal handler restores it

void put_back() { tcsetattr(STDIN_FILENO, TCSANOW, &before); }

void write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(fd, text.data(), text.size());
    if (count <= 0) return;  // the terminal is gone
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace

RawTerminal::RawTerminal() {
  if (tcgetattr(STDIN_FILENO, &before) != 0)
    throw Error("the input is no terminal, and keys can only be read from one");
  termios raw = before;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  raw.c_cc[VSUSP] = raw.c_cc[VQUIT] = _POSIX_VDISABLE;
  before_forced_exit(put_back);
  tcsetattr(STDIN_FILENO, TCSAFLUSH, &raw);  // keys that were pressed before must not steer
}

RawTerminal::~RawTerminal() {
  put_back();
  before_forced_exit(nullptr);
}

std::string RawTerminal::typed() {
  std::array<char, 64> keys{};
  const ssize_t count = read(STDIN_FILENO, keys.data(), keys.size());
  return count > 0 ? std::string(keys.data(), static_cast<std::size_t>(count)) : "";
}

TerminalSize terminal_size(int fd) {
  winsize size{};
  if (ioctl(fd, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
  return {size.ws_col, size.ws_row};
}

bool obeys_escapes(int fd) {
  const char* const kind = std::getenv("TERM");
  return isatty(fd) == 1 && kind != nullptr && *kind != '\0' && std::string_view(kind) != "dumb";
}

Picture::~Picture() {
  if (drawn_) write_all(fd_, "\033[?25h");
}

void Picture::draw(const std::string& text, const std::string& line) {
  if (redraws_)
    draw_over(plain_text(text));
  else
    add_line(plain_text(line));
}

void Picture::add_line(const std::string& line) {
  const auto now = std::chrono::steady_clock::now();
  if (line == line_ || now - line_at_ < kBetweenLines) return;
  line_ = line;
  line_at_ = now;
  write_all(fd_, line + "\n");
}

void Picture::draw_over(const std::string& text) {
  const TerminalSize size = terminal_size(fd_);
  std::string frame = drawn_ ? "" : "\033[?25l";
  if (lines_ > 0) frame += "\033[" + std::to_string(lines_) + "F";
  lines_ = 0;
  for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos && lines_ + 1 < size.rows;
       at = end + 1, ++lines_)
    frame += clipped(text.substr(at, end - at), size.columns) + "\033[K\n";
  write_all(fd_, frame + "\033[J");
  drawn_ = true;
}

std::string gauge(double fraction, int half) {
  const int filled = static_cast<int>(std::lround(std::clamp(fraction, -1.0, 1.0) * half));
  std::string text;
  for (int cell = -half; cell <= half; ++cell) {
    const bool full = cell < 0 ? cell >= filled : cell <= filled;
    text += cell == 0 ? "┃" : full ? "█" : "░";
  }
  return text;
}

}  // namespace astro::console
