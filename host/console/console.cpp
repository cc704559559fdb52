#include "host/console/console.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/interrupted.hpp"
#include "host/base/text/columns.hpp"
#include "host/base/text/plain_text.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/terminal.hpp"

namespace astro::console {
namespace {

constexpr auto kBarDelay = std::chrono::seconds(1);
constexpr auto kBetweenRedraws = std::chrono::milliseconds(80);
constexpr std::size_t kLongestSentence = 4000;  // bytes
constexpr std::string_view kClearLine = "\r\033[K";

/// A message may quote text from a file: a name with line feeds, a cell of megabytes. It becomes one line of
/// limited length.
std::string one_line(std::string_view sentence) {
  const bool too_long = sentence.size() > kLongestSentence;
  std::string line = plain_text(sentence.substr(0, kLongestSentence)) + (too_long ? " ..." : "");
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

void to_stderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

/// Breaks lines at blanks if they are too long for the terminal. Rows of a table stay as they are; they contain two blanks
/// in a row.
std::string fitted_to_terminal(const std::string& text) {
  if (!stderr_is_terminal()) return text;
  const std::size_t columns = terminal_size(STDERR_FILENO).columns;
  std::string fitted;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = std::string_view(text).substr(at, end - at);
    const bool breaks = columns_of(line) > columns && line.find("  ") == std::string_view::npos;
    fitted += breaks ? wrapped(line, columns) : std::string(line) + '\n';
    at = end + 1;
  }
  return fitted;
}

constexpr std::size_t kLongestAnswer = 65536;

const char* program_name = "";

// "study: 12 %, trial 60 of 500".
std::string progress_line(const std::string& what, double fraction, std::string_view note) {
  // For work without a known end there is no fraction, and only the note is shown.
  const std::string part = fraction > 0 ? fmt::format("{:.0f} %", 100 * std::min(fraction, 1.0)) : "";
  return fmt::format("{}: {}{}{}", what, part, part.empty() || note.empty() ? "" : ", ", note);
}

// How long a Ctrl-C that arrives just before a read can go unnoticed.
constexpr int kPollPeriod_ms = 50;

// Appends what has arrived on stdin to `bytes`; returns false at its end. Polls instead of blocking, because
// a signal that arrives between the check of its flag and a blocking read would be noticed only at the next
// key.
bool await_input(std::string& bytes) {
  while (true) {
    check_interrupt();
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, kPollPeriod_ms) <= 0) continue;
    std::array<char, 256> chunk{};
    const ssize_t count = read(STDIN_FILENO, chunk.data(), chunk.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.append(chunk.data(), static_cast<std::size_t>(count));
    return true;
  }
}

std::string read_ahead;  // answers typed, or piped in, before their question

// Long enough for a key that bounces or is hit twice, too short to be noticed.
constexpr int kQuiet_ms = 300;

void discard_typed_input() {
  if (!stdin_is_terminal()) return;
  read_ahead.clear();
  pollfd input{STDIN_FILENO, POLLIN, 0};
  do {
    check_interrupt();
    tcflush(STDIN_FILENO, TCIFLUSH);
  } while (poll(&input, 1, kQuiet_ms) > 0 && input.revents == POLLIN);  // not if the terminal is gone
  tcflush(STDIN_FILENO, TCIFLUSH);  // the beginning of a line, which poll() does not report
}

}  // namespace

void hold_standard_streams() {
  for (const auto& [stream, other_way] : {std::pair{0, O_WRONLY}, {1, O_RDONLY}, {2, O_RDONLY}})
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF) static_cast<void>(open("/dev/null", other_way));
}

bool stdin_is_terminal() { return isatty(STDIN_FILENO) == 1; }
bool stdout_is_terminal() { return isatty(STDOUT_FILENO) == 1; }
bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

void say(std::string_view line) { to_stderr(fitted_to_terminal(plain_text(line) + '\n')); }

void set_program_name(const char* name) { program_name = name; }

void complain(std::string_view sentence) {
  const bool colour = obeys_escapes(STDERR_FILENO);
  std::string text = fitted_to_terminal(fmt::format("{}: {}\n", program_name, one_line(sentence)));
  const std::size_t name = std::string_view(program_name).size() + 1;
  if (colour) text = "\033[31m" + text.substr(0, name) + "\033[0m" + text.substr(name);
  to_stderr(text);
}

std::string in_words(const std::filesystem::filesystem_error& error) {
  return fmt::format("cannot use '{}': {}", error.path1().string(), error.code().message());
}

void complain_without_memory(const char* sentence) {
  for (const char* part : {program_name, ": ", sentence, "\n"}) std::fputs(part, stderr);
}

std::string ask(const std::string& prompt) {
  to_stderr(plain_text(prompt));
  std::size_t end = 0;
  const auto arrives = [] {
    try {
      return await_input(read_ahead);
    } catch (const Interrupted&) {
      to_stderr("\n");  // ends the line of the question, as below
      throw;
    }
  };
  while ((end = read_ahead.find('\n')) == std::string::npos)
    if (!arrives()) {
      if (read_ahead.empty()) {
        to_stderr("\n");  // ends the line of the question, which is on the screen already
        throw Error(
            "the input ended where an answer was expected: answer at a terminal, or pipe all answers in");
      }
      return std::exchange(read_ahead, {});
    } else if (read_ahead.size() > kLongestAnswer) {
      throw Error(
          "the input has no end of a line where an answer was expected: give one answer in each line");
    }
  const std::string line = read_ahead.substr(0, end);
  read_ahead.erase(0, end + 1);
  return line;
}

std::string ask_before_acting(const std::string& prompt) {
  discard_typed_input();
  return ask(prompt);
}

bool confirm(const std::string& question) {
  if (!stdin_is_terminal())
    throw Error("'" + question + "' needs an answer and the input is no terminal",
                ConsoleProblem::nobody_agrees);
  const std::string answer = ask_before_acting(question + " [y/N] ");
  return answer == "y" || answer == "Y" || answer == "yes";
}

bool ProgressLines::due(std::chrono::steady_clock::duration elapsed) {
  if (elapsed < next_) return false;
  next_ = elapsed + std::min<std::chrono::steady_clock::duration>(elapsed, std::chrono::minutes(1));
  return true;
}

Progress::Progress(std::string what) : what_(std::move(what)), started_(std::chrono::steady_clock::now()) {}

Progress::~Progress() { clear(); }

// Where a line cannot be rewritten, prints a new one from time to time.
void Progress::add_line(double fraction, std::string_view note) {
  if (obeys_escapes(STDERR_FILENO)) return;
  if (lines_.due(std::chrono::steady_clock::now() - started_)) say(progress_line(what_, fraction, note));
}

bool Progress::due() {
  const auto now = std::chrono::steady_clock::now();
  if (!obeys_escapes(STDERR_FILENO) || now - started_ < kBarDelay || now - shown_ < kBetweenRedraws)
    return false;
  shown_ = now;
  return true;
}

void Progress::rewrite(const std::string& line) {
  visible_ = true;
  // A line that wraps could not be rewritten.
  to_stderr(
      fmt::format("{}{}", kClearLine, clipped(plain_text(line), terminal_size(STDERR_FILENO).columns - 1)));
}

void Progress::show(double fraction, std::string_view note) {
  add_line(fraction, note);
  if (!due()) return;
  constexpr int kCells = 20;
  const int full = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kCells + 0.5);
  std::string bar;
  for (int i = 0; i < kCells; ++i) bar += i < full ? "█" : "░";
  rewrite(fmt::format("{} {} {:3.0f} %  {}", what_, bar, 100 * std::clamp(fraction, 0.0, 1.0), note));
}

void Progress::show(std::string_view note) {
  add_line(0, note);
  if (due()) rewrite(fmt::format("{}  {}", what_, note));
}

void Progress::clear() {
  if (visible_) to_stderr(kClearLine);
  visible_ = false;
}

std::string table(const std::vector<std::vector<std::string>>& rows, std::string_view alignment) {
  const auto is_left = [&](std::size_t i) { return i < alignment.size() ? alignment[i] == 'l' : i == 0; };
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == widths.size()) widths.push_back(0);
      widths[i] = std::max(widths[i], columns_of(row[i]));
    }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - columns_of(row[i]), ' ');
      line += (i == 0 ? "" : "  ") + (is_left(i) ? row[i] + padding : padding + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace astro::console
