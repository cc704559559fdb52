#pragma once

#include <string>

#include "host/base/error.hpp"
#include "host/console/command_line.hpp"
#include "host/experiment/analysis/results.hpp"
#include "host/recording/files/run_file.hpp"

/// Recordings that are not whole, in commands that compute something from recordings.
namespace astro::commands {

void add_damaged_flag(console::Command command, bool& damaged);

/// What `read(damage)` returns; if it refuses a damaged recording, the error names the option that uses it.
template <class Read>
auto read_recordings(bool damaged, Read read) {
  try {
    return read(damaged ? recording::Damage::accepted : recording::Damage::refused);
  } catch (const recording::DamagedRecording& error) {
    throw Error(std::string(error.what()) + "; --damaged uses what can be read of it", error.remedy());
  }
}

/// Says which of them are not whole.
void warn_of_recordings(const std::vector<recording::Run>& runs);

/// The results of an experiment's folder, or of several folders of recordings. Says what speaks against them:
/// recordings that are not whole, and phases of different robots.
experiment::Results read_results_of(const std::vector<std::filesystem::path>& folders, bool damaged);

}  // namespace astro::commands
