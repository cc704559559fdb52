#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

#include "host/console/command_line.hpp"

/// Checks and texts that the options of many commands share.
namespace astro::console {

/// Accepts finite numbers from `least` to `greatest`; the message names both and the unit.
Check between(double least, double greatest, const std::string& unit);

/// Accepts finite numbers greater than 0.
Check positive(const std::string& unit);

/// Accepts whole numbers in decimal digits.
Check whole(std::uint64_t least, std::uint64_t greatest);

/// Accepts finite numbers.
Check finite();

/// Accepts "0.05%" or "0.0005", greater than 0; as a transform it leaves the plain number.
Check fraction();

/// An option with a number from `least` to `greatest`; the help shows the present value as the default.
Option add_ranged(Command command, const std::string& names, double& value, const std::string& what,
                  const std::string& type_name, double least, double greatest, const std::string& unit);

/// "Examples:" and one line each, as the footer of a command's help.
void examples(Command command, std::initializer_list<const char*> lines);

}  // namespace astro::console
