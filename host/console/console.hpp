#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The terminal: what a person sees on stderr, and what they answer. All that is printed goes through
/// plain_text, because names and messages hold text of robots and files.
namespace astro::console {

/// To be called before anything is opened: where standard input, output or error are closed, the next file
/// would take their place, and what is printed would go down a robot's line. Writing to them fails from then on.
void hold_standard_streams();

bool stdout_is_terminal();
bool stderr_is_terminal();

/// One line to stderr.
void say(std::string_view line);

/// "astrolabe: sentence" to stderr, the first word in red on a terminal.
void complain(std::string_view sentence);

/// "cannot use 'PATH': what the system said", for whatever no other sentence fits.
std::string in_words(const std::filesystem::filesystem_error& error);

/// The sentence that memory has run out; takes none itself.
void complain_of_memory();

/// Asks on stderr, reads a line from stdin. Throws astro::Error if stdin is no terminal: says that --yes
/// answers.
bool confirm(const std::string& question);

/// A line from stdin after a prompt on stderr. Throws astro::Error at the end of input, Interrupted on
/// Ctrl-C.
std::string ask(const std::string& prompt);

/// When progress is told where no line can be rewritten, as in a file or a pipe: after 10 s, then whenever
/// the time has doubled, but every minute at least. A short job says nothing, and the log of a long one stays
/// short.
class ProgressLines {
 public:
  /// True if a line is due now; `elapsed` since the beginning of the work.
  bool due(std::chrono::steady_clock::duration elapsed);

 private:
  std::chrono::steady_clock::duration next_ = std::chrono::seconds(10);
};

/// A bar on stderr that rewrites its line, shown only once a second has passed. Lines as ProgressLines says
/// where stderr is no terminal, or one that cannot rewrite.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` in [0, 1]; `note` stands behind the bar.
  void show(double fraction, std::string_view note = {});
  /// Without a bar, for work of which nobody knows the end.
  void show(std::string_view note);
  /// Takes the bar away, so that a line can be printed.
  void clear();

 private:
  void add_line(double fraction, std::string_view note);
  bool due();
  void rewrite(const std::string& line);

  std::string what_;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point shown_;
  ProgressLines lines_;
  bool visible_ = false;
};

/// Plain text columns; the first row is the heading. `alignment`: 'l' or 'r' per column; where it says
/// nothing the first is left-aligned and the others are right-aligned.
std::string table(const std::vector<std::vector<std::string>>& rows, std::string_view alignment = {});

/// `text` broken between words so that no line is longer than 80 columns; ends with a newline.
std::string wrapped(const std::string& text);

}  // namespace astro::console
