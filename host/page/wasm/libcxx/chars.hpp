#pragma once

#include <charconv>

/// What libc++ 16 declares or lacks and Emscripten's library does not have: numbers with a fraction from and to text. It is
/// included in front of every source.
namespace std {

from_chars_result from_chars(const char* first, const char* last, double& value);
from_chars_result from_chars(const char* first, const char* last, float& value);

}  // namespace std
