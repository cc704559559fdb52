#pragma once

#include <cstdint>

#include "hal/rp2040/arithmetic/supply_voltage.hpp"

namespace astro::rp2040 {

/// Voltage of the motor supply at GP26, behind the divider of arithmetic/supply_voltage.hpp. Each tick reads the conversion
/// that the tick before has started, so nothing waits.
///
/// Errors  if the converter does not convert the reading is 0 mV, like an empty battery.
class Battery {
 public:
  /// Waits for the first sample: some microseconds, and gives up after a millisecond.
  void start();

  /// Call it once per tick, because the filter counts time in calls.
  std::int32_t millivolts() noexcept;

 private:
  SupplyVoltage voltage_;
};

}  // namespace astro::rp2040
