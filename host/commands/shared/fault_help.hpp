#pragma once

#include <string_view>

#include "common/safety/fault.hpp"

namespace astro::commands {

/// What a fault means and what to check. "" for a fault that this version does not know.
std::string_view fault_help(Fault fault);

}  // namespace astro::commands
