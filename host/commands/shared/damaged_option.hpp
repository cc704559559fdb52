#pragma once

#include <string>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/command_line.hpp"
#include "host/recording/run_file.hpp"

/// Incomplete recordings, in commands that compute something from recordings.
namespace astro::commands {

void add_damaged_flag(console::Command command, bool& damaged);

/// Returns what `read(damage)` returns; if it refuses a damaged recording, the error names the option that
/// uses the rest of it.
template <class Read>
auto read_recordings(bool damaged, Read read) {
  try {
    return read(damaged ? recording::Damage::accepted : recording::Damage::refused);
  } catch (const recording::DamagedRecording& error) {
    throw Error(in_words(error) + "; --damaged uses what can be read of it");
  }
}

/// Prints a warning for each incomplete recording.
void warn_of_recordings(const std::vector<recording::Run>& runs);

}  // namespace astro::commands
