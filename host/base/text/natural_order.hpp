#pragma once

#include <string_view>

namespace astro {

/// Whether `a` comes before `b` when the digits in them are read as numbers.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace astro
