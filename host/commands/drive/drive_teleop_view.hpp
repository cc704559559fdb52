#pragma once

#include <string>

#include "host/console/keys.hpp"
#include "host/console/terminal.hpp"
#include "host/recording/run.hpp"

/// What `teleop` shows.
namespace astro::commands {

/// A picture for a terminal of this size: lines, each ended by a newline. It has the same content at 40
/// columns as at 80; the gauges get the free columns, and a terminal with few rows gets no explanation of the
/// keys.
std::string teleop_picture(const std::string& robot, const console::SteeringWheel& wheel,
                           const recording::OdometrySample& at, console::TerminalSize terminal);

/// For terminals that cannot redraw: the keys, and the present state, in one line each.
std::string teleop_keys();
std::string teleop_line(const console::SteeringWheel& wheel, const recording::OdometrySample& at);

}  // namespace astro::commands
