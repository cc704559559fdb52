#pragma once

#include <cstdint>

#include "hal/teensy40/arithmetic/supply_voltage.hpp"

namespace astro::teensy40 {

/// Voltage of the motor supply at pin A0, behind the divider of arithmetic/supply_voltage.hpp: each
/// conversion is begun by one tick and read by the next, so that nobody waits.
///
/// Errors  a converter that does not calibrate or convert leaves 0 mV: as good as an empty battery.
class Battery {
 public:
  /// Calibrates and waits for a first sample: some milliseconds; without an answer it gives up after some 50.
  void start();

  /// To be called once in a tick: the filter counts its time in calls.
  std::int32_t millivolts() noexcept;

 private:
  SupplyVoltage voltage_;
};

}  // namespace astro::teensy40
