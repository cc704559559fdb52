#pragma once

#include <string>
#include <vector>

#include "host/base/error.hpp"

namespace astro {

/// The system's reason for a value of errno: "permission denied". If no file, pipe or socket can be opened any more, it says
/// whose limit that is.
std::string system_reason(int code);

/// "`fact`: permission denied", followed by `advice`, which brings its own separator: "; choose another
/// folder". If no file can be opened any more, `advice` and `kind` are left out, because then nothing is
/// wrong with this file.
Error system_error(const std::string& fact, int code, const std::string& advice = {}, Kind kind = {},
                   std::vector<std::string> values = {});

}  // namespace astro
