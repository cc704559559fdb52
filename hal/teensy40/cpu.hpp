#pragma once

#include <cstdint>

/// The instructions that C++ has no words for.
namespace astro::teensy40::cpu {

/// Everything written so far has arrived.
inline void synchronize() { asm volatile("dsb" ::: "memory"); }

/// What is executed next is fetched, and decided on, anew.
inline void refetch() { asm volatile("isb" ::: "memory"); }

/// While one lives no interrupt runs; faults still do. They nest.
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
