#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/base/child_process.hpp"

namespace astro::film {

/// What goes wrong while a program reads a film. Values: the program's name, and for how many milliseconds it
/// was silent.
enum class FilmProgramProblem { silent };

/// A program that reads films, run as a child process. Its output is read as bytes, its error stream as
/// lines.
///
/// Errors  astro::Error if the program is not installed or cannot be started, or if it neither writes nor
///         ends for as long as `patience`, for example because it reads a pipe that nobody writes to.
class FilmProgram {
 public:
  /// `words`: the program, found along PATH, and its arguments. `line` is called while read() or finish() runs.
  FilmProgram(std::vector<std::string> words, ChildProcess::Line line,
              std::chrono::milliseconds patience = std::chrono::seconds(60));

  /// Fills `bytes`; returns how many came, which are fewer only at the end of the output.
  std::size_t read(std::span<std::uint8_t> bytes);

  /// Reads the rest of both streams, and waits for the program to end. Returns whether it succeeded.
  bool finish();

 private:
  /// The beginning of a sentence about the program.
  std::string described() const;
  void wait();

  std::string name_;
  std::chrono::milliseconds patience_;
  ChildProcess child_;
};

}  // namespace astro::film
