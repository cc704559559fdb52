#pragma once

#include <array>
#include <optional>
#include <string>

#include "host/commands/shared/connection.hpp"
#include "host/console/command_line.hpp"
#include "host/motor/wiring/wiring.hpp"

/// `astrolabe check-wiring`: what is asked, judged, shown and loaded.
namespace astro::commands {

struct WiringOptions {
  ConnectionOptions connection;
  double max_voltage_V = 4;
  std::array<std::string, 2> saw;  // by motor; empty: ask
  bool no_look = false, roll = false, upload = false, yes = false, json = false;
  std::optional<double> rolled_distance_m, rolled_turns;
};

/// "left-forward", "lf", ..., "none"; nullopt for what is no answer.
std::optional<motor::Sighting> sighting_from(const std::string& word);
std::string sighting_words();
console::Check a_sighting();

/// Throws astro::Error if the robot is not in order when it returns: wires to be changed, or parameters that
/// were not loaded.
void check_wiring(WiringOptions& options);

}  // namespace astro::commands
