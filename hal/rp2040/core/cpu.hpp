#pragma once

#include <cstdint>

#include "hal/rp2040/registers/registers.hpp"

namespace astro::rp2040 {

/// Instructions that C++ cannot express.
namespace cpu {

/// Waits until everything written so far has arrived (dsb).
inline void synchronize() { asm volatile("dsb" ::: "memory"); }

/// No interrupt runs while such an object lives; faults still do. The objects nest.
class [[nodiscard]] InterruptsOff {
 public:
  InterruptsOff() { asm volatile("mrs %0, primask\n cpsid i" : "=r"(before_)::"memory"); }
  ~InterruptsOff() { asm volatile("msr primask, %0" ::"r"(before_) : "memory"); }
  InterruptsOff(const InterruptsOff&) = delete;
  InterruptsOff& operator=(const InterruptsOff&) = delete;

 private:
  std::uint32_t before_;
};

}  // namespace cpu

/// Takes peripherals out of reset, where all begin. `which` are bits of RESETS.RESET. An access to a peripheral in reset
/// changes nothing.
inline void wake(std::uint32_t which) {
  RESETS[resets::RESET].clear(which);
  while ((RESETS[resets::RESET_DONE].read() & which) != which) {
  }
}

}  // namespace astro::rp2040
