#pragma once

#include <string>

#include "host/experiment/plan.hpp"

/// From the words that people type to the choices that they mean.
namespace astro::experiment {

/// "auto", "umbmark", "extended", "least-squares"; "x", "y", "thesis", "average"; "exact", "published".
/// Throws astro::Error naming the word and what it may be.
MethodChoice method_named(const std::string& method, const std::string& angles, const std::string& formula);

/// "alternating", "cw-first", "ccw-first".
Order order_named(const std::string& order);

}  // namespace astro::experiment
