#pragma once

#include <chrono>

namespace astro {

/// Times and durations on a link. Whose clock is read, and whether it is a real one, is said where they are used.
using std::chrono::microseconds;

}  // namespace astro
