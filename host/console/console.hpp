#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The terminal: what a person sees on stderr, and what they answer. Everything that is printed goes through
/// plain_text, because names and messages contain text from robots and files.
namespace astro::console {

enum class ConsoleProblem { nobody_agrees };

/// Must be called before any file is opened. If standard input, output or error is closed, the next file that
/// is opened would get its number, and printed text would be sent to a robot. This function opens /dev/null
/// there instead, so that writing fails.
void hold_standard_streams();

bool stdin_is_terminal();
bool stdout_is_terminal();
bool stderr_is_terminal();

/// One line to stderr.
void say(std::string_view line);

/// The name with which complain() begins. `name` has to live as long as the program. Program sets it.
void set_program_name(const char* name);

/// "NAME: sentence" to stderr, the first word in red on a terminal.
void complain(std::string_view sentence);

/// "cannot use 'PATH': what the system said", for errors that have no sentence of their own.
std::string in_words(const std::filesystem::filesystem_error& error);

/// The same without allocating memory, for when there is none; `sentence` is printed as it stands.
void complain_without_memory(const char* sentence);

/// Asks on stderr, reads a line from stdin, as ask_before_acting() does. Throws astro::Error with
/// ConsoleProblem::nobody_agrees if stdin is no terminal.
bool confirm(const std::string& question);

/// A line from stdin after a prompt on stderr. Throws astro::Error at the end of input, Interrupted on
/// Ctrl-C.
std::string ask(const std::string& prompt);

/// The same for a question whose answer moves a robot or writes its flash. What was typed at a terminal before the question
/// is discarded, because it is not its answer. The question is shown only when no line has come for 0.3 s, so that a
/// bouncing key is no answer either. Piped answers are taken in their order.
std::string ask_before_acting(const std::string& prompt);

/// When progress is reported where no line can be rewritten, as in a file or a pipe: after 10 s, then each
/// time the elapsed time has doubled, but at least every minute. A short job prints nothing, and the log of a
/// long one stays short.
class ProgressLines {
 public:
  /// True if a line is due now; `elapsed` is the time since the work began.
  bool due(std::chrono::steady_clock::duration elapsed);

 private:
  std::chrono::steady_clock::duration next_ = std::chrono::seconds(10);
};

/// A progress bar on stderr that rewrites its line; it appears after one second. If stderr is no terminal, or
/// one that cannot rewrite a line, it prints lines as ProgressLines says.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` in [0, 1]; `note` is shown after the bar.
  void show(double fraction, std::string_view note = {});
  /// Without a bar, for work without a known end.
  void show(std::string_view note);
  /// Removes the bar, so that a line can be printed.
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

/// Plain text columns; the first row is the heading. `alignment`: 'l' or 'r' per column; by default the first
/// column is left-aligned and the others are right-aligned.
std::string table(const std::vector<std::vector<std::string>>& rows, std::string_view alignment = {});

}  // namespace astro::console
