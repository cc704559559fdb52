#pragma once

#include <memory>
#include <string>

#include "host/console/command_line.hpp"

namespace astro::console {

/// A program's whole command line: says --help and --version, runs what was asked for, and puts wrong usage
/// into one sentence that names the word in question and the help that explains it.
class Program {
 public:
  Program(const std::string& name, const std::string& what);
  ~Program();

  /// What its options and subcommands are added to.
  Command command() { return Command(app_.get()); }
  void version(const std::string& text);

  /// The exit code: 0, or 2 after a sentence on stderr. What the callbacks throw comes through.
  int run(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace astro::console
