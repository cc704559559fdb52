#pragma once

#include <string>

#include "host/cli/wiring_check.hpp"
#include "host/identification/roll.hpp"
#include "host/tuning/robot_facts.hpp"

namespace astro::cli {

/// Has the robot rolled by hand, with its bridges open, and judges what it counted. The length is asked for,
/// or comes from the options: then it waits until the wheels have turned and stand again. Throws astro::Error
/// if nobody rolls it.
identification::RollVerdict roll(link::Client& client, const tuning::RobotFacts& facts,
                                 const WiringOptions& options);

/// As ask; throws link::Interrupted if Ctrl-C ended the input.
std::string ask_or_interrupt(const std::string& prompt);

}  // namespace astro::cli
