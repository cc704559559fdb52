#pragma once

#include <string>

#include "host/commands/tune/wiring_dialogue.hpp"
#include "host/motor/bench/robot_facts.hpp"
#include "host/motor/wiring/roll.hpp"

namespace astro::commands {

/// Has the robot rolled by hand, with its bridges open, and judges what it counted. The length is asked for,
/// or comes from the options: then it waits until the wheels have turned and stand again. Throws astro::Error
/// if nobody rolls it.
motor::RollVerdict roll(robot::Client& client, const motor::RobotFacts& facts, const WiringOptions& options);

/// As ask; throws Interrupted if Ctrl-C ended the input.
std::string ask_or_interrupt(const std::string& prompt);

}  // namespace astro::commands
