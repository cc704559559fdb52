#pragma once

#include <string>

#include "host/formats/cdr/type_description.hpp"

namespace astro::ros2 {

/// "RIHS01_" and 64 hexadecimal digits: SHA-256 of the description as JSON.
///
/// Source  REP 2011; rosidl_generator_type_description.
std::string hash_of(const TypeDescription& description);

template <Message M>
const std::string& hash_of() {
  static const std::string hash = hash_of(describe<M>());
  return hash;
}

}  // namespace astro::ros2
