#pragma once

#include "hal/interface/board.hpp"

namespace astro::teensy40 {

/// Both wheels' quadrature, counted on all edges by the decoders ENC1 (left) and ENC2 (right) in 32 bits.
///
/// Filter  an edge counts if eight samples 0.33 us apart agree: noise shorter than 2.3 us never counts, a
///         level that lasts 2.7 us always does. That allows 300,000 counts a second; the motors make 12,000.
/// Cost    six reads of the peripheral bus.
class Encoders {
 public:
  void start();

  /// Call it from one context only: two reads of a decoder at the same time would mix their halves.
  hal::EncoderCounts read() noexcept;
};

}  // namespace astro::teensy40
