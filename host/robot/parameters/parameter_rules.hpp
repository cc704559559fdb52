#pragma once

#include <span>
#include <string>

#include "host/robot/parameters/parameter_row.hpp"

namespace astro::robot {

/// The rule that the staged value of `bad`, which the robot named when it refused the set, breaks, as a
/// clause with the limit, its unit and the values that it depends on: "it has to be above speed_limit = 0.75
/// m/s, or full speed would be a fault". `rows` is the whole table. Empty if this program knows no such rule:
/// the firmware may be newer. The rules are those of common/params/parameter_set.hpp.
std::string broken_rule(std::span<const ParameterRow> rows, const ParameterRow& bad);

}  // namespace astro::robot
