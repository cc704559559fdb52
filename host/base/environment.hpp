#pragma once

#include <cstdlib>
#include <string>

namespace astro {

/// What an environment variable holds; "" if it is not set.
inline std::string environment_variable(const char* name) {
  const char* const value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing here sets one
  return value == nullptr ? "" : value;
}

}  // namespace astro
