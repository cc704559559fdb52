#pragma once

#include <cstdint>

#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {

/// Instructions that C++ cannot express.
namespace cpu {

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

}  // namespace cpu

/// Switches on the clock of a peripheral, in run and in wait mode. An access to a peripheral without its
/// clock hangs the bus. Start-up only, because it reads, changes and writes a shared register.
inline void open_gate(Register<std::uint32_t> ccgr, Bits gate) { ccgr.modify(0, gate(3)); }

/// Reads until `field` is `value`; returns false after `reads` reads, so that nothing waits for ever.
///
/// Cost    a read of a peripheral takes 10 ns or more, so `reads` also is a lower bound of the time.
template <class W>
[[nodiscard]] inline bool poll(Register<W> reg, Bits field, std::uint32_t value, std::uint32_t reads) {
  for (; reads != 0; --reads)
    if (reg.get(field) == value) return true;
  return false;
}

}  // namespace astro::teensy40
