#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/base/child_process.hpp"

namespace astro::film {

/// Values: the name of the program, and for how many milliseconds.
enum class FilmProgramProblem { silent };

/// A program that reads films, which runs beside this one: its output as bytes, what it says on its error
/// stream as lines.
///
/// Errors  astro::Error if the program is not installed or cannot be started, or if it neither writes nor ends
///         for as long as `patience`: what it reads may be a pipe that nobody writes to.
class FilmProgram {
 public:
  /// `words`: the program, found along PATH, and its arguments. `line` is called while read() or finish() runs.
  FilmProgram(std::vector<std::string> words, ChildProcess::Line line,
              std::chrono::milliseconds patience = std::chrono::seconds(60));

  /// Fills `bytes`; returns how many came, which are fewer only at the end of the output.
  std::size_t read(std::span<std::uint8_t> bytes);

  /// Reads the rest of both streams, and waits. Whether the program ended well.
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
