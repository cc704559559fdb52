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
/// Both PWMs come from one counter and change together, at the beginning of a period of 50 us. A motor that
/// turns round is braked at once and gets its new duty at that beginning: no duty of one direction ever meets
/// the pins of the other.
///
/// The registers are the state: no call depends on one before. drive() and brake() are for one context at a
/// time; a coast() that interrupts them for good, as a fault handler's does, has the last word.
class Motors {
 public:
  /// Outputs low first, then everything else. Coasts.
  void start();

  void drive(hal::Duty duty) noexcept;
  void brake() noexcept;

  /// Two stores, the first of which opens the bridges. Any context, fault handlers too; before start()
  /// FlexPWM may be without its clock, and a fault handler then clears the direction pins alone.
  static void coast() noexcept;

  /// The chip pulls its outputs LO1 and LO2 low: over-current, over-temperature, or a motor that is not
  /// connected. What is low for less than a microsecond is noise and not reported.
  ///
  /// Cost    one read if all is well, some microseconds if not.
  bool fault() noexcept;
};

}  // namespace astro::teensy40
