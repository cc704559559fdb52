#pragma once

#include <cstdlib>

/// What a test does each time and what it could do. `./dev test` has minutes for all tests together, `./dev fuzz 60 thorough` as
/// many as each test likes.
namespace astro::support {

inline bool thorough() { return std::getenv("ASTROLABE_THOROUGH") != nullptr; }

/// How often something is repeated.
inline int how_often(int each_time, int could) { return thorough() ? could : each_time; }

/// How many of inputs that are all alike are tried: every fourth where each costs ten times as much.
inline int how_many_alike(int of) {
#ifdef ASTRO_SANITIZE
  if (!thorough()) return (of + 3) / 4;
#endif
  return of;
}

/// Why a test is left out that does nothing each time: GTEST_SKIP() << support::kLeftToThorough.
inline constexpr const char* kLeftToThorough =
    "takes too long for each time; ./dev fuzz 60 thorough takes it";

}  // namespace astro::support
