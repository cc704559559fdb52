#pragma once

#include "hal/interface/board.hpp"

namespace astro::teensy40 {

/// Both wheels' quadrature, counted on all edges by the decoders ENC1 (left) and ENC2 (right) in 32 bits.
///
/// Filter  an edge counts when eight samples 0.33 us apart agree: noise shorter than 2.3 us never does, a
///         level that lasts 2.7 us always. That is 300,000 counts a second; the motors give 12,000.
/// Cost    six reads of the peripheral bus.
class Encoders {
 public:
  void start();

  /// One context only: reading one decoder twice at once would mix the two readings.
  hal::EncoderCounts read() noexcept;
};

}  // namespace astro::teensy40
