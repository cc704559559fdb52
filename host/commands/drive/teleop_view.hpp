#pragma once

#include <string>

#include "host/console/keys.hpp"
#include "host/console/terminal.hpp"
#include "host/recording/run/run.hpp"

/// What `teleop` shows.
namespace astro::commands {

/// A picture for a terminal of this size: lines, each ended by a newline. It says the same at 40 columns as
/// at 80; the gauges get what room there is, and a terminal with few rows does without the explanation of the
/// keys.
std::string teleop_picture(const std::string& robot, const console::SteeringWheel& wheel,
                           const recording::OdometrySample& at, console::TerminalSize terminal);

/// For terminals where nothing can be drawn over: the keys, and what is steered, in one line each.
std::string teleop_keys();
std::string teleop_line(const console::SteeringWheel& wheel, const recording::OdometrySample& at);

}  // namespace astro::commands
