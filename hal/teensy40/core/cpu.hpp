#pragma once

#include <cstdint>

/// Instructions that C++ cannot express.
namespace astro::teensy40::cpu {

/// Waits until everything written so far has arrived (dsb).
inline void synchronize() { asm volatile("dsb" ::: "memory"); }

/// Discards fetched instructions, so that the next ones are fetched again (isb).
inline void refetch() { asm volatile("isb" ::: "memory"); }

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

}  // namespace astro::teensy40::cpu
