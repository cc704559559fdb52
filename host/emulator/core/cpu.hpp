#pragma once

#include <unicorn/unicorn.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "host/emulator/core/machine.hpp"
#include "host/emulator/core/memory.hpp"
#include "host/emulator/core/protection.hpp"

namespace astro::emulator {

/// The instruction engine: registers, memories, and callbacks to the rest of the machine.
///
/// Uses    Unicorn, with three peculiarities. If it is stopped during a register access, it rewinds the
///         program counter and repeats the access, so it is only stopped between blocks of instructions. If
///         it is stopped there, the program counter may be at an instruction that has run already. It does
///         not handle exceptions, so Hooks::exception must.
class Cpu {
 public:
  /// Callbacks of the engine.
  struct Hooks {
    std::function<bool()> interrupted;  // before each block: true ends the run there
    std::function<void()> spinning;     // a branch to itself, which only an event outside can end
    std::function<std::uint32_t(std::uint32_t address, int bytes)> read;
    std::function<void(std::uint32_t address, std::uint32_t value, int bytes)> write;
    // EXC_RETURN, SVC, BKPT by the engine's numbers; false: the run cannot go on.
    std::function<bool(std::uint32_t number)> exception;
    // An access within set_traps(): true ends the run.
    std::function<bool(std::uint32_t address)> trapped;
  };
  static constexpr std::uint32_t kThumb = 1U << 24;  // of the program status
  enum class End : std::uint8_t { interrupted, sleeping, bad_access, bad_instruction, not_thumb };
  struct BadAccess {
    std::uint32_t address = 0;
    bool write = false, fetch = false;
  };

  Cpu(Memory& memory, Hooks hooks);
  ~Cpu();
  Cpu(const Cpu&) = delete;
  Cpu& operator=(const Cpu&) = delete;

  std::uint32_t get(int reg) const;
  void set(int reg, std::uint32_t value);
  std::uint32_t pc() const { return get(UC_ARM_REG_PC); }
  /// Must be called after IPSR or the Thumb bit was written, because the engine keeps copies of them.
  void refresh();

  /// Runs until a hook or an instruction ends it.
  End run();
  const BadAccess& bad_access() const { return bad_; }

  /// Sets what the processor may do from `base` on; everything else ends in bad_access. Whole pages of
  /// Protection::kPage. Must not be called from a hook.
  void allow(std::uint32_t base, std::uint32_t bytes, const Protection::Access& access);
  /// Ranges of any size: an access there for which Hooks::trapped returns true ends in bad_access, after its
  /// block of instructions. Must not be called from a hook.
  void set_traps(const std::vector<Protection::Span>& traps);

  std::uint64_t instructions() const { return instructions_; }

  /// Called with the address and number of instructions of each block that is about to run; empty: not
  /// called.
  std::function<void(std::uint32_t address, std::uint32_t instructions)> trace;

 private:
  static void on_block(uc_engine* engine, std::uint64_t address, std::uint32_t bytes, void* self);
  static void on_interrupt(uc_engine* engine, std::uint32_t number, void* self);
  static bool on_invalid(uc_engine* engine, uc_mem_type type, std::uint64_t address, int bytes,
                         std::int64_t value, void* self);
  static void on_trap(uc_engine* engine, uc_mem_type type, std::uint64_t address, int bytes,
                      std::int64_t value, void* self);
  template <std::uint32_t Base>
  static std::uint64_t on_read(uc_engine* engine, std::uint64_t offset, unsigned bytes, void* self);
  template <std::uint32_t Base>
  static void on_write(uc_engine* engine, std::uint64_t offset, unsigned bytes, std::uint64_t value,
                       void* self);
  template <std::uint32_t Base>
  void map_registers(std::size_t bytes);
  std::uint32_t count(std::uint32_t address, std::uint32_t bytes);
  bool branches_to_itself(std::uint32_t address);

  struct Block {
    std::uint32_t address = ~0U, bytes = 0, instructions = 0;
  };

  Memory& memory_;
  Hooks hooks_;
  uc_engine* engine_ = nullptr;
  std::vector<Block> blocks_;
  std::uint64_t instructions_ = 0;
  bool stopping_ = false, trapped_ = false;
  std::optional<std::uint32_t> stopped_before_;  // the block before which the engine was stopped
  std::vector<uc_hook> traps_;
  BadAccess bad_;
};

}  // namespace astro::emulator
