#include "host/emulator/core/system_control.hpp"

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/core/register_names.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kCacheEnabled = 0x0003'0000;
constexpr std::uint32_t kResetKey = 0x05FA;
constexpr std::uint32_t kPriorityGroup = 0x700;  // of AIRCR
constexpr std::uint32_t kNvicEnd = 0xE000'E4A0;

std::uint32_t pending_bits(const Exceptions& exceptions) {
  return static_cast<std::uint32_t>(exceptions.pending(exception::kPendSv)) << 28 |
         static_cast<std::uint32_t>(exceptions.pending(exception::kSysTick)) << 26;
}

}  // namespace

void SystemControl::reset() {
  protection_.reset();
  counting_ = tick_flag_ = false;
  ccr_ = cpacr_ = demcr_ = tick_control_ = tick_reload_ = counter_held_ = 0;
  tick_at_ = kNever;
}

void SystemControl::leave_rom_state() {
  tick_control_ = 7;
  tick_reload_ = 23'999;
  tick_at_ = machine_.now() + tick_cycles();
  exceptions_.leave_rom_state();
}

Cycles SystemControl::tick_cycles() const {
  // The reference clock is 100 kHz on this chip, whatever the manual says.
  return Cycles{tick_reload_ + 1} * ((tick_control_ & 4) != 0 ? 1 : kCyclesPerSecond / 100'000);
}

void SystemControl::event() {
  tick_flag_ = true;
  tick_at_ += tick_cycles();
  if ((tick_control_ & 2) != 0) exceptions_.pend(exception::kSysTick);
}

/// The tightly coupled memories are never cached, whatever their region says.
bool SystemControl::cached(std::uint32_t address) const {
  return (ccr_ & kCacheEnabled) != 0 && address >= Memory::kOcram && protection_.at(address).cached;
}

std::uint32_t SystemControl::read_priorities(int first) const {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value |= std::uint32_t{exceptions_.priority(first + i)} << (8 * i);
  return value;
}

void SystemControl::write_priorities(int first, std::uint32_t value) {
  for (int i = 0; i < 4; ++i)
    exceptions_.set_priority(first + i, static_cast<std::uint8_t>(value >> (8 * i)));
}

std::uint32_t SystemControl::read_nvic(std::uint32_t offset) const {
  if (offset >= 0x300) return read_priorities(static_cast<int>(exception::kFirstInterrupt + offset - 0x300));
  std::uint32_t value = 0;
  const int first = static_cast<int>(exception::kFirstInterrupt + offset % 0x80 * 8);
  for (int i = 0; i < 32; ++i) {
    const bool bit = offset < 0x100 ? exceptions_.enabled(first + i) : exceptions_.pending(first + i);
    value |= static_cast<std::uint32_t>(bit) << i;
  }
  return value;
}

void SystemControl::write_nvic(std::uint32_t offset, std::uint32_t value) {
  if (offset >= 0x300)
    return write_priorities(static_cast<int>(exception::kFirstInterrupt + offset - 0x300), value);
  const int first = static_cast<int>(exception::kFirstInterrupt + offset % 0x80 * 8);
  for (int i = 0; i < 32; ++i) {
    if ((value >> i & 1) == 0) continue;
    if (offset < 0x80) exceptions_.enable(first + i, true);
    if (offset >= 0x80 && offset < 0x100) exceptions_.enable(first + i, false);
    if (offset >= 0x100 && offset < 0x180) exceptions_.pend(first + i);
    if (offset >= 0x180) exceptions_.unpend(first + i);
  }
}

std::uint32_t SystemControl::read_scb(std::uint32_t offset) const {
  if (offset == scb::CPUID.value) return 0x411F'C271;
  if (offset == scb::ICSR.value)
    return static_cast<std::uint32_t>(exceptions_.running()) | pending_bits(exceptions_);
  if (offset == scb::VTOR.value) return exceptions_.vector_table;
  if (offset == scb::CCR.value) return ccr_;
  if (offset >= scb::SHPR1.value && offset <= scb::SHPR3.value)
    return read_priorities(static_cast<int>(4 + offset - scb::SHPR1.value));
  if (offset == scb::SHCSR.value)
    return scb::SHCSR_MEMFAULTENA(exceptions_.mem_manage_enabled) |
           scb::SHCSR_BUSFAULTENA(exceptions_.bus_fault_enabled) |
           scb::SHCSR_USGFAULTENA(exceptions_.usage_fault_enabled);
  if (offset == scb::CFSR.value) return exceptions_.cfsr;
  if (offset == scb::HFSR.value) return exceptions_.hfsr;
  if (offset == scb::MMFAR.value) return exceptions_.mmfar;
  if (offset == scb::BFAR.value) return exceptions_.bfar;
  if (offset == scb::CPACR.value) return cpacr_;
  return 0;
}

void SystemControl::write_icsr(std::uint32_t value) {
  if ((value >> 28 & 1) != 0) exceptions_.pend(exception::kPendSv);
  if ((value >> 27 & 1) != 0) exceptions_.clear(exception::kPendSv);
  if ((value >> 26 & 1) != 0) exceptions_.pend(exception::kSysTick);
  if ((value >> 25 & 1) != 0) exceptions_.clear(exception::kSysTick);
}

void SystemControl::write_aircr(std::uint32_t value) {
  if (scb::AIRCR_VECTKEY.of(value) != kResetKey)
    return machine_.fail({"SCB AIRCR: written without its key", ControlProblem::reset_without_key});
  if ((value & kPriorityGroup) != 0)
    machine_.fail({"SCB AIRCR: subpriorities are not modelled", ControlProblem::subpriorities});
  if (scb::AIRCR_SYSRESETREQ.of(value) != 0) machine_.restart(Reset::software);
}

void SystemControl::write_scb(std::uint32_t offset, std::uint32_t value) {
  if (offset == scb::ICSR.value) return write_icsr(value);
  if (offset == scb::VTOR.value) {
    if (value % 1024 != 0)
      machine_.fail({"SCB VTOR: a table of 176 entries must lie at a multiple of 1024",
                     ControlProblem::vectors_misaligned});
    exceptions_.vector_table = value;
  } else if (offset == scb::AIRCR.value) {
    write_aircr(value);
  } else if (offset == scb::CCR.value) {
    ccr_ = value;
  } else if (offset >= scb::SHPR1.value && offset <= scb::SHPR3.value) {
    write_priorities(static_cast<int>(4 + offset - scb::SHPR1.value), value);
  } else if (offset == scb::SHCSR.value) {
    exceptions_.mem_manage_enabled = scb::SHCSR_MEMFAULTENA.of(value) != 0;
    exceptions_.bus_fault_enabled = scb::SHCSR_BUSFAULTENA.of(value) != 0;
    exceptions_.usage_fault_enabled = scb::SHCSR_USGFAULTENA.of(value) != 0;
  } else if (offset == scb::CFSR.value) {
    exceptions_.cfsr &= ~value;
  } else if (offset == scb::HFSR.value) {
    exceptions_.hfsr &= ~value;
  } else if (offset == scb::CPACR.value) {
    cpacr_ = value;
  } else if (offset == scb::DCIMVAC.value) {
    on_invalidate(value);
  }
  // The other registers are for cache maintenance, and no cache is modelled.
}

std::uint32_t SystemControl::read_tick(std::uint32_t offset) {
  if (offset == systick::CSR.value) {
    const std::uint32_t value = tick_control_ | (tick_flag_ ? 1U << 16 : 0);
    tick_flag_ = false;
    return value;
  }
  if (offset == systick::RVR.value) return tick_reload_;
  if (tick_at_ == kNever || tick_at_ <= machine_.now()) return 0;
  return static_cast<std::uint32_t>((tick_at_ - machine_.now() - 1) / (tick_cycles() / (tick_reload_ + 1)));
}

void SystemControl::write_tick(std::uint32_t offset, std::uint32_t value) {
  if (offset == systick::CSR.value) {
    const bool starts = (tick_control_ & 1) == 0 && (value & 1) != 0;
    if (tick_at_ != kNever && (value & 1) != 0 && ((tick_control_ ^ value) & 4) != 0)
      machine_.fail(
          {"SysTick CSR: the clock is changed while it counts", ControlProblem::tick_clock_changed});
    tick_control_ = value & 7;
    if (starts) tick_at_ = machine_.now() + tick_cycles();
    if ((value & 1) == 0) tick_at_ = kNever;
  } else if (offset == systick::RVR.value) {
    tick_reload_ = value & 0xFF'FFFF;
  } else {
    tick_flag_ = false;
    if (tick_at_ != kNever) tick_at_ = machine_.now() + tick_cycles();
  }
}

std::uint32_t SystemControl::counter() const {
  return counting_ ? static_cast<std::uint32_t>(machine_.now() - counter_zero_) : counter_held_;
}

void SystemControl::write_trace(std::uint32_t address, std::uint32_t value) {
  if (dcb::DEMCR_TRCENA.of(demcr_) == 0)
    return machine_.fail({name_of(address) + ": tracing is not enabled in DCB DEMCR",
                          ControlProblem::tracing_off,
                          {name_of(address)}});
  const std::uint32_t count = address == DWT[dwt::CYCCNT].address() ? value : counter();
  if (address == DWT[dwt::CTRL].address()) counting_ = (value & 1) != 0;
  counter_held_ = count;
  counter_zero_ = machine_.now() - count;
}

std::uint32_t SystemControl::read(std::uint32_t address) {
  if (address >= SysTick.base && address < NVIC.base) return read_tick(address - SysTick.base);
  if (address >= NVIC.base && address < kNvicEnd) return read_nvic(address - NVIC.base);
  if (address >= MPU.base && address <= MPU[mpu::RASR].address()) return protection_.read(address - MPU.base);
  if (address == DCB[dcb::DEMCR].address()) return demcr_;
  if (address == DWT[dwt::CTRL].address()) return counting_ ? 1 : 0;
  if (address == DWT[dwt::CYCCNT].address()) return counter();
  return read_scb(address - SCB.base);
}

void SystemControl::write(std::uint32_t address, std::uint32_t value) {
  if (address >= SysTick.base && address < NVIC.base)
    write_tick(address - SysTick.base, value);
  else if (address >= NVIC.base && address < kNvicEnd)
    write_nvic(address - NVIC.base, value);
  else if (address >= MPU.base && address <= MPU[mpu::RASR].address())
    protection_.write(address - MPU.base, value);
  else if (address == DCB[dcb::DEMCR].address())
    demcr_ = value;
  else if (address == DWT[dwt::CTRL].address() || address == DWT[dwt::CYCCNT].address())
    write_trace(address, value);
  else
    write_scb(address - SCB.base, value);
}

}  // namespace astro::emulator
