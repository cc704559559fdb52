#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/console/command_line.hpp"

namespace astro::console {

/// To be called by a command that answers a question, as grep does, if the answer is no: the command did its work. The
/// program ends with kAnswerIsNo.
void answer_no();
inline constexpr int kAnswerIsNo = 3;

/// A program's whole command line: prints --help and --version, runs the command that was given, and turns
/// wrong usage into one sentence that names the wrong word and the help that explains it.
class Program {
 public:
  /// From here on error messages begin with `name`, which must live as long as the process.
  Program(const char* name, const char* what);
  ~Program();

  /// The command to which options and subcommands are added.
  Command command() { return Command(app_.get()); }
  void version(const std::string& text);
  /// The words between `begin` and `end`, or the end of the command line, look like options but belong to another program.
  /// Each becomes a value of the option `begin`, which a command may or may not have.
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
