#pragma once

#include <array>
#include <optional>
#include <string>

#include "host/commands/shared/connection.hpp"
#include "host/motor/bench/robot_facts.hpp"
#include "host/motor/model/roll.hpp"
#include "host/motor/model/wiring.hpp"

/// The parts of `astrolabe check-wiring` that need no program around them: an answer, and the roll by hand.
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

/// Has the robot rolled by hand, with its bridges open, and judges what it counted. The length is asked for,
/// or comes from the options: then it waits until the wheels have turned and stand again. Throws astro::Error
/// if nobody rolls it.
motor::RollVerdict roll(robot::Client& client, const motor::RobotFacts& facts, const WiringOptions& options);

}  // namespace astro::commands
