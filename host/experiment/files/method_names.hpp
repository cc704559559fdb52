#pragma once

#include <string>
#include <string_view>

#include "host/calibration/motion/trajectory.hpp"
#include "host/experiment/files/plan.hpp"

/// The names of methods and orders that people type.
namespace astro::experiment {

/// What is wrong with a name. Values: the word, the kind of name that was expected, and the valid names.
enum class NameProblem { unknown };

inline constexpr std::string_view kAutomaticName = "auto";
inline constexpr std::string_view kMlName = "ml";
inline constexpr std::string_view kScanName = "scan";

/// "auto", "ml", "scan", "umbmark", "extended", "least-squares", "robust"; "x", "y", "thesis", "average"; "exact", "published".
/// Throws astro::Error naming the word and what it may be.
MethodChoice method_named(const std::string& method, const std::string& angles, const std::string& formula);

/// The name that method_named takes.
std::string_view name_of(const MethodChoice& method);

/// "rest", "line", "arc", "spin".
std::string_view name_of(calibration::Motion motion);

/// "alternating", "cw-first", "ccw-first".
Order order_named(const std::string& order);

}  // namespace astro::experiment
