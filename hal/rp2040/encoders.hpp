#pragma once

#include "hal/interface/board.hpp"

namespace astro::rp2040 {

/// Both wheels' quadrature, counted on all edges in 32 bits by two state machines of PIO0 that run one program
/// (arithmetic/quadrature.hpp).
///
/// Filter  none: a pulse on one line counts up and down again.
/// Cost    four to ten reads of the peripheral bus. The counts are at most 0.1 us old, and 0.2 us apart.
class Encoders {
 public:
  void start();

  /// Call it from one context only: two reads of a queue at the same time would share its values.
  hal::EncoderCounts read() noexcept;
};

}  // namespace astro::rp2040
