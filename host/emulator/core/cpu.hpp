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

/// The instruction engine: registers, memories, and the callbacks by which the rest of the machine takes
/// part.
///
/// Why     Unicorn, with three habits to mind: stopping it from a register access rewinds the program counter
/// and repeats what was done, so it is only stopped between blocks of instructions; stopped there it may
/// leave the program counter at an instruction that has run; and exceptions are left to us.
class Cpu {
 public:
  /// What the machine does when the engine asks.
  struct Hooks {
    std::function<bool()> interrupted;  // before each block: true ends the run there
    std::function<void()> spinning;     // a branch to itself: only what happens outside gets it out
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
  /// The engine keeps the state of IPSR and of the Thumb bit apart: to be called after either was written.
  void refresh();

  /// Runs until a hook or an instruction ends it.
  End run();
  const BadAccess& bad_access() const { return bad_; }

  /// What the processor may do from `base` on; all else ends in bad_access. Whole pages of Protection::kPage.
  /// Not from within a hook.
  void allow(std::uint32_t base, std::uint32_t bytes, const Protection::Access& access);
  /// Ranges of any size: an access there that Hooks::trapped minds ends in bad_access, after the block of
  /// instructions that it is in. Not from within a hook.
  void set_traps(const std::vector<Protection::Span>& traps);

  std::uint64_t instructions() const { return instructions_; }

  /// Called with the address and number of instructions of each block that is about to run; empty: nobody.
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
  std::optional<std::uint32_t> stopped_before_;  // the block that a stop kept from running
  std::vector<uc_hook> traps_;
  BadAccess bad_;
};

}  // namespace astro::emulator
