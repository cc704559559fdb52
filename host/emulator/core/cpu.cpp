#include "host/emulator/core/cpu.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace astro::emulator {
namespace {

void check(uc_err error, const char* what) {
  if (error != UC_ERR_OK)
    throw std::runtime_error(std::string("Unicorn: ") + what + ": " + uc_strerror(error));
}

/// An empty hook for each instruction makes the engine keep the program counter up to date; without it, it
/// knows only where the block began, and faults and messages would name that address.
void on_instruction(uc_engine*, std::uint64_t, std::uint32_t, void*) {}

constexpr std::size_t kBlocks = 65536;

}  // namespace

Cpu::Cpu(Memory& memory, Hooks hooks) : memory_(memory), hooks_(std::move(hooks)), blocks_(kBlocks) {
  check(uc_open(UC_ARCH_ARM, UC_MODE_THUMB, &engine_), "open");
  check(uc_ctl_set_cpu_model(engine_, UC_CPU_ARM_CORTEX_M7), "processor");
  for (const Memory::Range& range : memory_.largest())
    check(uc_mem_map_ptr(engine_, range.base, range.bytes.size(), UC_PROT_NONE, range.bytes.data()),
          "memory");
  map_registers<0x4000'0000>(0x40'0000);
  map_registers<0x4200'0000>(0x10'0000);
  map_registers<0xE000'0000>(0x10'0000);
  uc_hook hook = 0;
  check(uc_hook_add(engine_, &hook, UC_HOOK_BLOCK, reinterpret_cast<void*>(on_block), this, 1, 0),
        "block hook");
  check(uc_hook_add(engine_, &hook, UC_HOOK_CODE, reinterpret_cast<void*>(on_instruction), this, 1, 0),
        "instruction hook");
  check(uc_hook_add(engine_, &hook, UC_HOOK_INTR, reinterpret_cast<void*>(on_interrupt), this, 1, 0),
        "interrupts");
  check(uc_hook_add(engine_, &hook, UC_HOOK_MEM_INVALID, reinterpret_cast<void*>(on_invalid), this, 1, 0),
        "faults");
}

Cpu::~Cpu() { uc_close(engine_); }

template <std::uint32_t Base>
void Cpu::map_registers(std::size_t bytes) {
  check(uc_mmio_map(engine_, Base, bytes, on_read<Base>, this, on_write<Base>, this), "registers");
}

template <std::uint32_t Base>
std::uint64_t Cpu::on_read(uc_engine*, std::uint64_t offset, unsigned bytes, void* self) {
  return static_cast<Cpu*>(self)->hooks_.read(Base + static_cast<std::uint32_t>(offset),
                                              static_cast<int>(bytes));
}

template <std::uint32_t Base>
void Cpu::on_write(uc_engine*, std::uint64_t offset, unsigned bytes, std::uint64_t value, void* self) {
  static_cast<Cpu*>(self)->hooks_.write(Base + static_cast<std::uint32_t>(offset),
                                        static_cast<std::uint32_t>(value), static_cast<int>(bytes));
}

std::uint32_t Cpu::get(int reg) const {
  std::uint32_t value = 0;
  uc_reg_read(engine_, reg, &value);
  return value;
}

void Cpu::set(int reg, std::uint32_t value) { uc_reg_write(engine_, reg, &value); }

void Cpu::refresh() { set(UC_ARM_REG_APSR_NZCV, get(UC_ARM_REG_CPSR)); }

/// A halfword of 0xE800 or more begins an instruction of two halfwords.
std::uint32_t Cpu::count(std::uint32_t address, std::uint32_t bytes) {
  Block& known = blocks_[address / 2 % kBlocks];
  if (known.address == address && known.bytes == bytes) return known.instructions;
  const auto code = memory_.at(address, bytes);
  std::uint32_t instructions = 0;
  for (std::size_t i = 0; i + 1 < code.size(); i += code[i + 1] >= 0xE8 ? 4 : 2) ++instructions;
  known = {address, bytes, instructions};
  return instructions;
}

bool Cpu::branches_to_itself(std::uint32_t address) {
  constexpr std::array<std::uint8_t, 2> kBranch{0xFE, 0xE7};
  const auto code = memory_.at(address, kBranch.size());
  return std::equal(code.begin(), code.end(), kBranch.begin(), kBranch.end());
}

void Cpu::on_block(uc_engine* engine, std::uint64_t address, std::uint32_t bytes, void* self) {
  auto& cpu = *static_cast<Cpu*>(self);
  if (cpu.stopping_) return;
  if (cpu.trapped_ || cpu.hooks_.interrupted()) {
    cpu.stopping_ = true;
    cpu.stopped_before_ = static_cast<std::uint32_t>(address);
    uc_emu_stop(engine);
    return;
  }
  const std::uint32_t instructions = cpu.count(static_cast<std::uint32_t>(address), bytes);
  cpu.instructions_ += instructions;
  if (cpu.trace) cpu.trace(static_cast<std::uint32_t>(address), instructions);
  if (bytes == 2 && cpu.branches_to_itself(static_cast<std::uint32_t>(address))) cpu.hooks_.spinning();
}

void Cpu::on_interrupt(uc_engine* engine, std::uint32_t number, void* self) {
  auto& cpu = *static_cast<Cpu*>(self);
  if (cpu.hooks_.exception(number)) return;
  cpu.stopping_ = true;
  uc_emu_stop(engine);
}

bool Cpu::on_invalid(uc_engine*, uc_mem_type type, std::uint64_t address, int, std::int64_t, void* self) {
  static_cast<Cpu*>(self)->bad_ = {static_cast<std::uint32_t>(address),
                                   type == UC_MEM_WRITE_UNMAPPED || type == UC_MEM_WRITE_PROT,
                                   type == UC_MEM_FETCH_UNMAPPED || type == UC_MEM_FETCH_PROT};
  return false;
}

void Cpu::on_trap(uc_engine*, uc_mem_type type, std::uint64_t address, int, std::int64_t, void* self) {
  auto& cpu = *static_cast<Cpu*>(self);
  if (cpu.trapped_ || !cpu.hooks_.trapped(static_cast<std::uint32_t>(address))) return;
  cpu.trapped_ = true;
  cpu.bad_ = {static_cast<std::uint32_t>(address), type == UC_MEM_WRITE, false};
}

void Cpu::allow(std::uint32_t base, std::uint32_t bytes, const Protection::Access& access) {
  std::uint32_t rights = UC_PROT_NONE;
  if (access.read) rights |= UC_PROT_READ;
  if (access.write) rights |= UC_PROT_WRITE;
  if (access.execute) rights |= UC_PROT_EXEC;
  check(uc_mem_protect(engine_, base, bytes, rights), "protection");
  // Code that was translated before would run without checking the memory again.
  if (!access.execute) check(uc_ctl_remove_cache(engine_, base, std::uint64_t{base} + bytes), "translations");
}

void Cpu::set_traps(const std::vector<Protection::Span>& traps) {
  for (const uc_hook hook : traps_) check(uc_hook_del(engine_, hook), "traps");
  traps_.clear();
  for (const Protection::Span& trap : traps)
    check(uc_hook_add(engine_, &traps_.emplace_back(), UC_HOOK_MEM_READ | UC_HOOK_MEM_WRITE,
                      reinterpret_cast<void*>(on_trap), this, trap.base, trap.base + trap.bytes - 1),
          "traps");
}

Cpu::End Cpu::run() {
  stopping_ = false;
  stopped_before_.reset();
  const uc_err error = uc_emu_start(engine_, pc() | 1U, 1, 0, 0);
  // The program counter may still be at the last instruction of the block before, which would run twice.
  if (stopped_before_) set(UC_ARM_REG_PC, *stopped_before_ | 1U);
  if (std::exchange(trapped_, false)) return End::bad_access;
  if (stopping_) return End::interrupted;
  switch (error) {
    case UC_ERR_OK:
      return End::sleeping;
    case UC_ERR_INSN_INVALID:
    case UC_ERR_EXCEPTION:
      return (get(UC_ARM_REG_XPSR) & kThumb) != 0 ? End::bad_instruction : End::not_thumb;
    default:
      return End::bad_access;
  }
}

}  // namespace astro::emulator
