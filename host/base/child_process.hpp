#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/descriptor.hpp"

namespace astro {

/// A program that runs beside this one. Its output is read as bytes, and its error stream as lines. Its input
/// is empty. The destructor ends it.
///
/// Threads  one. wait() watches both streams, so that neither can block the program.
class ChildProcess {
 public:
  /// Gets each line that is not empty, cut to 4096 bytes.
  using Line = std::function<void(std::string_view)>;
  /// `lines`: the output is read as lines, too.
  enum class Output : std::uint8_t { bytes, lines };

  ChildProcess() = default;
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// May be called once. `words`: the program, found along PATH unless it names a folder, and its arguments. `line` is called
  /// by wait() alone. Returns 0, or the value of errno that says why it cannot be started. Throws astro::Error if no pipe can
  /// be made.
  int start(std::vector<std::string> words, Output output, Line line);

  /// True until the program has closed the stream.
  bool writes_bytes() const { return static_cast<bool>(output_); }
  bool writes_lines() const { return static_cast<bool>(lines_); }

  /// Waits until the program has written to a stream or closed it, or a signal has come. False if none of
  /// these happens within `patience`. Throws astro::Error if the system has too little memory.
  bool wait(std::chrono::milliseconds patience);

  /// The bytes that have come; returns their number, maybe 0.
  std::size_t read(std::span<std::uint8_t> bytes);

  /// Asks the program to end by itself (SIGTERM).
  void terminate() const;

  /// Waits until the program has ended, and kills it after `patience`. Closed streams do not mean that it has ended. Returns
  /// its exit status; nothing if a signal ended it.
  std::optional<int> finish(std::chrono::milliseconds patience);

 private:
  void take_lines();
  void end_line();

  Line line_;
  std::string unfinished_;  // the beginning of a line
  pid_t pid_ = -1;
  Descriptor output_, lines_;
};

}  // namespace astro
