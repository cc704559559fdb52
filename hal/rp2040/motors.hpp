#pragma once

#include "hal/interface/board.hpp"

namespace astro::rp2040 {

/// Two H-bridges with two inputs each (arithmetic/duty_counts.hpp) and one line that enables the driver chip: TB6612FNG,
/// DRV8833, TB67H420FTG and others like them.
///
/// Both inputs of a bridge come from one slice of the PWM and change together, at the beginning of its period of 50 us.
/// So a change of direction never drives the motor by a mixture of both.
///
/// While the bridges are open the pins are forced low, whatever the PWM does, and the driver is disabled. The registers are
/// the only state, so no call depends on an earlier one. drive() and brake() may be called from one context at a time.
/// After a coast() that interrupts them and does not return, as a fault handler's, the bridges stay open.
class Motors {
 public:
  /// Sets the outputs low first, then the rest. Coasts.
  void start();

  void drive(hal::Duty duty) noexcept;
  void brake() noexcept;

  /// Some stores without an interrupt in between, of which the first disables the driver. Callable from any context,
  /// including fault handlers, and before start(), where the stores change nothing and all pins are inputs.
  static void coast() noexcept;

  /// The driver chip pulls its line low: over-current, over-temperature, or no motor connected. A pulse of less than a
  /// microsecond is taken for noise and not reported.
  ///
  /// Cost    one read if all is well, two microseconds if not.
  bool fault() noexcept;
};

}  // namespace astro::rp2040
