#pragma once

#include <cstdint>

#include "hal/teensy40/arithmetic/supply_voltage.hpp"

namespace astro::teensy40 {

/// Voltage of the motor supply at pin A0, behind the divider of arithmetic/supply_voltage.hpp. Each tick
/// reads the conversion that the tick before has started, so nothing waits.
///
/// Errors  if the converter does not calibrate or convert the reading is 0 mV, like an empty battery.
class Battery {
 public:
  /// Calibrates and waits for the first sample: some milliseconds. Gives up after some 50 ms.
  void start();

  /// Call it once per tick, because the filter counts time in calls.
  std::int32_t millivolts() noexcept;

 private:
  SupplyVoltage voltage_;
};

}  // namespace astro::teensy40
