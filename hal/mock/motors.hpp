#pragma once

#include "hal/interface/board.hpp"

namespace astro::mock {

enum class Bridge : std::uint8_t { coast, brake, drive };

/// H-bridges without motors, which remember the calls.
struct Motors {
  Bridge state = Bridge::coast;
  hal::Duty duty;  // of the last drive(); brake() and coast() do not change it
  bool faulted = false;
  int drives = 0, brakes = 0, coasts = 0;  // calls so far

  void drive(hal::Duty wanted) noexcept {
    state = Bridge::drive;
    duty = wanted;
    ++drives;
  }
  void brake() noexcept {
    state = Bridge::brake;
    ++brakes;
  }
  void coast() noexcept {
    state = Bridge::coast;
    ++coasts;
  }
  bool fault() noexcept { return faulted; }
};

}  // namespace astro::mock
