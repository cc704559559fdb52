#pragma once

#include <cmath>
#include <string>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"

namespace astro {

/// Why a setting is refused. Values: its name and its value.
enum class SettingProblem { not_positive };

/// Refuses what is not a finite number above zero. `what` is named with its unit: "the side of the square in
/// metres".
inline void require_positive(double value, const std::string& what) {
  if (std::isfinite(value) && value > 0) return;
  throw Error(what + " is " + to_text(value) + ", and has to be a positive number",
              SettingProblem::not_positive, {what, to_text(value)});
}

}  // namespace astro
