#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace astro::film {

/// What is wrong with another program. Values: its name, and for how many milliseconds.
enum class ChildProblem { silent };

/// A program that runs beside this one: its output as bytes, what it says on its error stream as lines. The destructor ends it.
///
/// Threads  one. Both streams are read together, so that neither can block the program.
/// Errors   astro::Error if the program is not installed or cannot be started, or if it neither writes nor ends for as long as
///          `patience`: what it reads may be a pipe that nobody writes to.
class ChildProcess {
 public:
  using Line = std::function<void(std::string_view)>;

  /// `words`: the program, found along PATH, and its arguments. `line` is called while read() or finish() runs.
  ChildProcess(std::vector<std::string> words, Line line,
               std::chrono::milliseconds patience = std::chrono::seconds(60));
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Fills `bytes`; returns how many came, which are fewer only at the end of the output.
  std::size_t read(std::span<std::uint8_t> bytes);

  /// Reads the rest of both streams, and waits. Whether the program ended well.
  bool finish();

 private:
  void wait_for_streams();  // until the output has bytes or has ended; takes the error stream meanwhile
  void take_words();
  void end_words();
  [[noreturn]] void fail_silent() const;
  int wait();

  std::string name_;
  Line line_;
  std::chrono::milliseconds patience_;
  std::string unfinished_;  // the beginning of a line
  pid_t pid_ = -1;
  int output_ = -1, words_ = -1;
};

}  // namespace astro::film
