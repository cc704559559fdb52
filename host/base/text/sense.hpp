#pragma once

#include <optional>
#include <string_view>

namespace astro {

/// The direction in which a path turns, seen from above.
enum class Sense { cw, ccw };

constexpr Sense opposite(Sense sense) { return sense == Sense::cw ? Sense::ccw : Sense::cw; }

/// The sign of the heading's change: 1 counter-clockwise, -1 clockwise.
constexpr double sign_of(Sense sense) { return sense == Sense::cw ? -1 : 1; }

/// As names, columns and files write it: "cw", "ccw".
constexpr std::string_view name_of(Sense sense) { return sense == Sense::cw ? "cw" : "ccw"; }

/// The inverse of name_of; empty for any other text.
constexpr std::optional<Sense> sense_named(std::string_view name) {
  for (const Sense sense : {Sense::cw, Sense::ccw}) {
    if (name == name_of(sense)) return sense;
  }
  return {};
}

/// "clockwise", "counter-clockwise".
constexpr const char* in_words(Sense sense) { return sense == Sense::cw ? "clockwise" : "counter-clockwise"; }

}  // namespace astro
