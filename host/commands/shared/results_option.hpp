#pragma once

#include <filesystem>
#include <vector>

#include "host/console/command_line.hpp"
#include "host/experiment/analysis/results.hpp"

namespace astro::commands {

/// Which results a command shows: those of an experiment's folder, or of several folders of recordings.
struct ResultsOption {
  std::vector<std::filesystem::path> folders;
  bool damaged = false;
};

console::Option add_results(console::Command command, ResultsOption& option);

/// Prints warnings about incomplete recordings and about phases of different robots.
experiment::Results read_results(const ResultsOption& option);

}  // namespace astro::commands
