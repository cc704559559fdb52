#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "hal/interface/board.hpp"
#include "hal/sim/battery.hpp"
#include "hal/sim/drivetrain.hpp"

namespace astro::sim {

enum class Bridge : std::uint8_t { coast, brake, drive };

/// Both H-bridges, with their wiring. PWM is averaged: the motor gets duty times supply, as with slow decay
/// and a PWM period far below L / R. A duty of 0 therefore brakes.
class Motors {
 public:
  explicit Motors(const Wiring& wiring)
      : wiring_(wiring), off_{wiring.left_motor_dead, wiring.right_motor_dead} {}

  void drive(hal::Duty duty) noexcept {
    state_ = Bridge::drive;
    duty_ = duty;
  }
  void brake() noexcept { state_ = Bridge::brake; }
  void coast() noexcept { state_ = Bridge::coast; }
  bool fault() noexcept { return fault_; }

  /// The driver chip reports a fault, and keeps both bridges open for as long as it does.
  void set_fault(bool fault) { fault_ = fault; }

  /// A lead of that wheel's motor comes off.
  void disconnect(Side wheel) { off_[at(wheel)] = true; }
  void connect(Side wheel) { off_[at(wheel)] = false; }

  Bridge state() const { return state_; }
  hal::Duty duty() const { return duty_; }  // of the last drive()

  /// The bridges' state by wheel.
  Drive at_wheels(const Battery& battery) const {
    Drive drive{.supply_V = battery.open_circuit_V(), .supply_ohm = battery.resistance_ohm()};
    const bool open = fault_ || state_ == Bridge::coast;
    drive.open = {open || off_[0], open || off_[1]};
    if (open || state_ == Bridge::brake) return drive;
    const double left = fraction(duty_.left), right = fraction(duty_.right);
    drive.duty = wiring_.motors_swapped ? Pair{right, left} : Pair{left, right};
    if (wiring_.left_motor_reversed) drive.duty[0] = -drive.duty[0];
    if (wiring_.right_motor_reversed) drive.duty[1] = -drive.duty[1];
    return drive;
  }

 private:
  static double fraction(std::int16_t duty) { return std::max(-1.0, duty * (1.0 / 32767.0)); }

  Wiring wiring_;
  std::array<bool, 2> off_;  // by wheel
  Bridge state_ = Bridge::coast;
  hal::Duty duty_;
  bool fault_ = false;
};

}  // namespace astro::sim
