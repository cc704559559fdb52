#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

/// A libFuzzer target is two functions: one takes bytes that anybody may have written, the other makes the
/// bytes to begin with, by the code that writes them in earnest. target.cpp does the rest:
///
///   fuzz.NAME --seeds FOLDER    writes the seeds into FOLDER and ends
///   fuzz.NAME FOLDER ...        libFuzzer
namespace astro::fuzz {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Ends the program (abort, a sanitizer, an exception that is none of the parser's own) if the parser is
/// wrong.
void take(ByteView input);

std::vector<Bytes> seeds();

inline Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }
inline std::string_view text_of(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A law that the parser keeps whatever the input.
void require(bool holds, const char* law);

}  // namespace astro::fuzz
