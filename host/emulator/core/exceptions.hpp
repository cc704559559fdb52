#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "host/base/error.hpp"
#include "host/emulator/core/cpu.hpp"

namespace astro::emulator {

/// The numbers of the core's own exceptions; interrupt n is 16 + n.
namespace exception {
inline constexpr int kNmi = 2, kHardFault = 3, kMemManage = 4, kBusFault = 5, kUsageFault = 6, kSvc = 11,
                     kPendSv = 14, kSysTick = 15, kFirstInterrupt = 16, kCount = 16 + 160;
}

/// What is wrong with the entry into a handler or the return from it. The value is the exception's number,
/// the value that it returns with, or the address of the stack.
enum class ExceptionProblem {
  process_stack_used,
  no_handler,
  return_from_none,
  context_unused_here,
  stack_in_no_memory
};

/// The nested vectored interrupt controller, and how the core enters and leaves handlers.
///
/// Not modelled  the floating point context and the process stack: the image uses neither
///               (tests/target/image); a program that uses one ends the run.
class Exceptions {
 public:
  Exceptions(Cpu& cpu, Memory& memory, const Protection& protection)
      : cpu_(cpu), memory_(memory), protection_(protection) {}
  void reset();
  /// As a boot ROM may leave it: exceptions are pending, all interrupts enabled, and an old fault is
  /// recorded.
  void leave_rom_state();

  // State that the system control space reads and writes.
  std::uint32_t vector_table = 0;
  bool mem_manage_enabled = false, bus_fault_enabled = false, usage_fault_enabled = false;
  std::uint32_t cfsr = 0, hfsr = 0, mmfar = 0, bfar = 0;
  void enable(int number, bool on) { enabled_[index(number)] = on; }
  bool enabled(int number) const { return enabled_[index(number)]; }
  void set_priority(int number, std::uint8_t byte) { priority_[index(number)] = byte & 0xF0; }
  std::uint8_t priority(int number) const { return priority_[index(number)]; }
  void pend(int number);
  void clear(int number);
  /// Clears a pending exception by software; without effect while the peripheral's line is up.
  void unpend(int number);
  bool pending(int number) const { return pending_[index(number)]; }
  int running() const { return static_cast<int>(cpu_.get(UC_ARM_REG_IPSR) & 0x1FF); }

  /// Sets a peripheral's line. A rising edge is remembered even if the line falls before the handler runs;
  /// while the line is up, the interrupt becomes pending again as soon as its handler has ended.
  void set_line(int irq, bool level);

  /// The exception that must be taken now.
  std::optional<int> due() const;
  /// Whether a pending exception would end a WFI, for which PRIMASK is ignored.
  bool wakes() const;
  /// Enters the handler of `number`. False if the core has locked up.
  bool enter(int number);
  /// Returns from a handler that has put this value into the program counter.
  void leave(std::uint32_t return_value);
  /// Handles an instruction that could not be executed, or an exception `number` that cannot be taken where
  /// it must be. Returns the exception that follows, or nothing if the core has locked up. `cause`: the bits
  /// of the cause in CFSR.
  std::optional<int> fault(int number, std::uint32_t cause = 0);

  /// The rule that the firmware broke, if any: no handler, a return without an exception.
  std::optional<Remark> violation;

 private:
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }
  bool can_take(int number) const;
  std::optional<int> push_frame(std::uint32_t sp, std::uint32_t frame);
  int level(int number) const;
  int running_level(bool with_masks) const;
  int best() const;

  Cpu& cpu_;
  Memory& memory_;
  const Protection& protection_;
  std::array<bool, exception::kCount> enabled_{}, pending_{}, active_{}, line_{};
  std::array<std::uint8_t, exception::kCount> priority_{};
  int pending_count_ = 0;
};

}  // namespace astro::emulator
