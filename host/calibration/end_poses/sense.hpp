#pragma once

namespace astro::calibration {

/// The direction in which a closed path is driven.
enum class Sense { cw, ccw };

/// "clockwise", "counter-clockwise".
constexpr const char* in_words(Sense sense) { return sense == Sense::cw ? "clockwise" : "counter-clockwise"; }

}  // namespace astro::calibration
