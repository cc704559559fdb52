#pragma once

namespace astro {

/// Why text in a file is not the number that is needed. Values: its name and at most 40 characters of its
/// text.
enum class NumberProblem { not_a_count };

}  // namespace astro
