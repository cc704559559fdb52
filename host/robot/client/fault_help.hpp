#pragma once

#include <string_view>

#include "common/safety/fault.hpp"

namespace astro::robot {

/// What a fault means and what to check, as a clause. "" for a fault that this version does not know.
std::string_view fault_help(Fault fault);

}  // namespace astro::robot
