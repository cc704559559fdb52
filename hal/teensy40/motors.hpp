#pragma once

#include "hal/interface/board.hpp"

namespace astro::teensy40 {

/// The driver chip TB67H420FTG: a PWM and two direction inputs for each motor.
///
///   IN1 IN2 PWM
///    1   0   1    forward
///    0   1   1    reverse
///   not 0 0  0    short brake: so a duty of 0 brakes, and the motor sees duty times supply
///    0   0   -    coast
///
/// Both PWMs come from one counter and change together, at the beginning of a period of 50 us. If a motor's
/// direction changes it is braked at once and gets its new duty at the next beginning, so a duty is never
/// applied with the direction pins of the other sign.
///
/// The registers are the only state, so no call depends on an earlier one. drive() and brake() may be called
/// from one context at a time. After a coast() that interrupts them and does not return, as a fault
/// handler's, the bridges stay open.
class Motors {
 public:
  /// Sets the outputs low first, then the rest. Coasts.
  void start();

  void drive(hal::Duty duty) noexcept;
  void brake() noexcept;

  /// Two stores, of which the first opens the bridges. Callable from any context, including fault handlers.
  /// Before start() FlexPWM may have no clock; a fault handler then clears only the direction pins.
  static void coast() noexcept;

  /// The driver chip pulls LO1 or LO2 low: over-current, over-temperature, or no motor connected. A pulse of
  /// less than a microsecond is taken for noise and not reported.
  ///
  /// Cost    one read if all is well, some microseconds if not.
  bool fault() noexcept;
};

}  // namespace astro::teensy40
