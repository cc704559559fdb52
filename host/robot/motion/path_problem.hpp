#pragma once

namespace astro::robot {

/// A path or speed that is not possible. Values: the quantity with its unit, and the number.
enum class PathProblem { impossible_number };

}  // namespace astro::robot
