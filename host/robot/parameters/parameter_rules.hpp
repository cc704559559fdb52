#pragma once

#include <span>
#include <string>

#include "host/robot/parameters/parameter_row.hpp"

namespace astro::robot {

/// The rule that the staged value of `bad` breaks, as a clause with the limit, its unit and the values that
/// it depends on: "it has to be above speed_limit = 0.75 m/s, or full speed would be a fault". The robot
/// named `bad` when it refused the set; `rows` is the whole table. Empty if this program knows no such rule,
/// because the firmware may be newer. The rules are those of common/params/parameter_set.hpp.
std::string broken_rule(std::span<const ParameterRow> rows, const ParameterRow& bad);

}  // namespace astro::robot
