#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/console/command_line.hpp"

namespace astro::console {

/// For a command that answers a question, as grep does: it did its work, and the answer is no. The program ends
/// with kAnswerIsNo.
void answer_no();
inline constexpr int kAnswerIsNo = 3;

/// A program's whole command line: prints --help and --version, runs the command that was given, and turns
/// wrong usage into one sentence that names the wrong word and the help that explains it.
class Program {
 public:
  /// From here on the program complains under this name, which has to live as long as the process.
  Program(const char* name, const char* what);
  ~Program();

  /// The command to which options and subcommands are added.
  Command command() { return Command(app_.get()); }
  void version(const std::string& text);
  /// The words between `begin` and `end`, or the last one, look like options and are those of another program. Each becomes a value
  /// of an option whose name is `begin`, which a command has or has not.
  void foreign_words(const std::string& begin, const std::string& end);

  /// Returns the exit code: 0, what answer_no() says, or 2 after a sentence on stderr. Exceptions of the callbacks
  /// pass through.
  int run(int argc, char** argv);

 private:
  std::vector<std::string> with_values(int argc, char** argv) const;

  std::unique_ptr<CLI::App> app_;
  std::string foreign_begin_, foreign_end_;
};

}  // namespace astro::console
