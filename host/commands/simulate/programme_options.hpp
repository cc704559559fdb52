#pragma once

#include <array>
#include <string>

#include "host/console/command_line.hpp"
#include "host/simulation/study/programme.hpp"

/// A programme of drives as options, the same for 'plan', which forecasts it, and 'record', which drives it.
namespace astro::commands {

struct ProgrammeOptions {
  std::array<console::Option, simulation::study::kKinds> counts;
  /// Whether numbers of runs were given, even if they are 0.
  bool named() const;
};

/// --squares, --lines, --spins, --circles; their sizes; --speed and --yaw-rate.
ProgrammeOptions add_programme(console::Command command, simulation::study::Programme& programme);

/// The options that give `programme`, without those at their default: "--lines 3 --spins 2".
std::string options_for(const simulation::study::Programme& programme);

}  // namespace astro::commands
