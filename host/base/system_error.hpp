#pragma once

#include <string>
#include <vector>

#include "host/base/error.hpp"

namespace astro {

/// What the system said, by errno's value: "permission denied". If no file, pipe or socket can be opened any more, whose limit it is.
std::string system_reason(int code);

/// "`fact`: permission denied". Then `advice`, with its joint: "; choose another folder"; but
/// neither it nor the kind if no file can be opened any more, because then nothing is wrong with that one.
Error system_error(const std::string& fact, int code, const std::string& advice = {}, Kind kind = {},
                   std::vector<std::string> values = {});

}  // namespace astro
