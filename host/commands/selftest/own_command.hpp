#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/child_process.hpp"

namespace astro::commands {

/// This program once more, in a process of its own, as somebody would start it in a second terminal.
class OwnCommand {
 public:
  /// Throws astro::Error if it cannot be started.
  explicit OwnCommand(const std::vector<std::string>& words);
  OwnCommand(const OwnCommand&) = delete;
  OwnCommand& operator=(const OwnCommand&) = delete;

  /// Waits until a line contains `text`, and returns the first that does. Throws astro::Error with the command's last line if it
  /// ends before or does not say so within `limit`, Interrupted on Ctrl-C.
  std::string line_with(std::string_view text, std::chrono::seconds limit = std::chrono::seconds(30));

  /// The same for the first line that it prints on stdout.
  std::string first_line(std::chrono::seconds limit = std::chrono::seconds(30));

  /// Waits for its end. Returns all that it printed on stdout. Throws astro::Error with its last line if it fails or takes
  /// longer than `limit`, Interrupted on Ctrl-C.
  std::string output(std::chrono::seconds limit = std::chrono::seconds(60));

  /// Asks it to end (SIGTERM) and waits until it has. Throws astro::Error if it does not end with 0.
  void end();

 private:
  /// Reads what has come. Throws astro::Error if nothing comes within what is left until `end`.
  void listen(std::chrono::steady_clock::time_point end);

  std::string name_, output_;
  std::vector<std::string> said_;  // its lines on stderr
  ChildProcess process_;           // after said_, which gets its last lines
};

}  // namespace astro::commands
