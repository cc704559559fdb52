#include "host/emulator/core/exceptions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/base/bytes.hpp"

namespace astro::emulator {
namespace {

constexpr std::array kFrame{UC_ARM_REG_R0, UC_ARM_REG_R1,  UC_ARM_REG_R2,
                            UC_ARM_REG_R3, UC_ARM_REG_R12, UC_ARM_REG_LR};
constexpr std::uint32_t kFrameBytes = 32;
constexpr std::uint32_t kAligned = 1U << 9;
constexpr std::uint32_t kStackingDenied = 1U << 4, kStackingBusError = 1U << 12;  // CFSR
constexpr std::uint32_t kProcessStack = 1U << 1;                                  // of CONTROL
constexpr int kNothing = 256;

}  // namespace

void Exceptions::reset() {
  enabled_ = pending_ = active_ = line_ = {};
  priority_ = {};
  pending_count_ = 0;
  vector_table = 0;
  mem_manage_enabled = bus_fault_enabled = usage_fault_enabled = false;
  cfsr = hfsr = mmfar = bfar = 0;
  violation.reset();
}

void Exceptions::leave_rom_state() {
  for (const int number : {exception::kPendSv, exception::kSysTick, exception::kFirstInterrupt}) pend(number);
  for (int number = exception::kFirstInterrupt; number < exception::kCount; ++number) enable(number, true);
  cfsr = kStackingBusError;
}

void Exceptions::pend(int number) {
  if (pending_[index(number)]) return;
  pending_[index(number)] = true;
  ++pending_count_;
}

void Exceptions::clear(int number) {
  if (!pending_[index(number)]) return;
  pending_[index(number)] = false;
  --pending_count_;
}

void Exceptions::set_line(int irq, bool level) {
  const int number = exception::kFirstInterrupt + irq;
  if (level && !line_[index(number)]) pend(number);
  line_[index(number)] = level;
}

void Exceptions::unpend(int number) {
  if (!line_[index(number)] || active_[index(number)]) clear(number);
}

int Exceptions::level(int number) const {
  if (number == exception::kNmi) return -2;
  if (number == exception::kHardFault) return -1;
  return priority_[index(number)];
}

int Exceptions::running_level(bool with_masks) const {
  int level_now = kNothing;
  for (int number = 1; number < exception::kCount; ++number)
    if (active_[index(number)]) level_now = std::min(level_now, level(number));
  if (const std::uint32_t base = cpu_.get(UC_ARM_REG_BASEPRI) & 0xF0; base != 0)
    level_now = std::min(level_now, static_cast<int>(base));
  if (with_masks && (cpu_.get(UC_ARM_REG_PRIMASK) & 1) != 0) level_now = std::min(level_now, 0);
  if (with_masks && (cpu_.get(UC_ARM_REG_FAULTMASK) & 1) != 0) level_now = std::min(level_now, -1);
  return level_now;
}

int Exceptions::best() const {
  int found = 0;
  for (int number = exception::kNmi; number < exception::kCount; ++number)
    if (pending_[index(number)] && (number < exception::kFirstInterrupt || enabled_[index(number)]) &&
        (found == 0 || level(number) < level(found)))
      found = number;
  return found;
}

std::optional<int> Exceptions::due() const {
  if (pending_count_ == 0) return {};
  const int number = best();
  if (number == 0 || level(number) >= running_level(true)) return {};
  return number;
}

bool Exceptions::wakes() const {
  if (pending_count_ == 0) return false;
  const int number = best();
  return number != 0 && level(number) < running_level(false);
}

/// Returns the exception that follows if there is no memory for the frame.
std::optional<int> Exceptions::push_frame(std::uint32_t sp, std::uint32_t frame) {
  const bool allowed = protection_.at(frame).write && protection_.at(frame + kFrameBytes - 4).write;
  const auto stack = memory_.at(frame, kFrameBytes);
  if (!allowed || stack.empty()) {
    cfsr |= allowed ? kStackingBusError : kStackingDenied;
    return allowed ? exception::kBusFault : exception::kMemManage;
  }
  std::array<std::uint32_t, 8> words{};
  for (std::size_t i = 0; i < kFrame.size(); ++i) words[i] = cpu_.get(kFrame[i]);
  words[6] = cpu_.pc() & ~1U;
  words[7] = (cpu_.get(UC_ARM_REG_XPSR) & ~kAligned) | Cpu::kThumb | ((sp & 4) != 0 ? kAligned : 0);
  for (std::size_t i = 0; i < words.size(); ++i) store(stack, 4 * i, words[i]);
  return {};
}

bool Exceptions::enter(int number) {
  const std::uint32_t sp = cpu_.get(UC_ARM_REG_SP), frame = (sp - kFrameBytes) & ~7U;
  const bool nested = running() != 0;
  if ((cpu_.get(UC_ARM_REG_CONTROL) & kProcessStack) != 0)
    violation = {"the process stack is not modelled", ExceptionProblem::process_stack_used};
  if (const std::optional<int> failed = push_frame(sp, frame)) {
    // The intended exception stays pending; the handler of this fault runs without a frame.
    const std::optional<int> derived = level(number) < 0 ? std::nullopt : fault(*failed);
    if (!derived) return false;
    number = *derived;
  }
  cpu_.set(UC_ARM_REG_SP, frame);
  cpu_.set(UC_ARM_REG_IPSR, static_cast<std::uint32_t>(number));
  cpu_.set(UC_ARM_REG_LR, nested ? 0xFFFF'FFF1 : 0xFFFF'FFF9);
  cpu_.set(UC_ARM_REG_EPSR, Cpu::kThumb);
  active_[index(number)] = true;
  clear(number);
  std::uint32_t handler = 0;
  if (const auto entry = memory_.at(vector_table + 4 * static_cast<std::uint32_t>(number), 4); !entry.empty())
    handler = load<std::uint32_t>(entry, 0);
  if ((handler & 1) == 0 || memory_.at(handler & ~1U, 2).empty())
    violation = {fmt::format("exception {} has no handler in the vector table", number),
                 ExceptionProblem::no_handler,
                 {std::to_string(number)}};
  cpu_.set(UC_ARM_REG_PC, handler);
  cpu_.refresh();
  return true;
}

void Exceptions::leave(std::uint32_t return_value) {
  const int number = running();
  if (number == 0 || !active_[index(number)]) {
    violation = {"a return from an exception that does not run", ExceptionProblem::return_from_none};
    return;
  }
  if ((return_value & 0x1C) != 0x18 && (return_value & 0x1C) != 0x10) {
    const std::string shown = fmt::format("0x{:08X}", return_value);
    violation = {"EXC_RETURN " + shown + " asks for a stack or a context that is not used here",
                 ExceptionProblem::context_unused_here,
                 {shown}};
    return;
  }
  active_[index(number)] = false;
  if (number != exception::kNmi) cpu_.set(UC_ARM_REG_FAULTMASK, 0);
  if (line_[index(number)]) pend(number);
  const std::uint32_t sp = cpu_.get(UC_ARM_REG_SP);
  const auto stack = memory_.at(sp, kFrameBytes);
  if (stack.empty()) {
    const std::string shown = fmt::format("0x{:08X}", sp);
    violation = {"the stack at " + shown + " is no memory to return from",
                 ExceptionProblem::stack_in_no_memory,
                 {shown}};
    return;
  }
  std::array<std::uint32_t, 8> words{};
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = load<std::uint32_t>(stack, 4 * i);
  for (std::size_t i = 0; i < kFrame.size(); ++i) cpu_.set(kFrame[i], words[i]);
  cpu_.set(UC_ARM_REG_SP, (sp + kFrameBytes) | ((words[7] & kAligned) != 0 ? 4U : 0U));
  cpu_.set(UC_ARM_REG_IPSR, words[7] & 0x1FF);
  cpu_.set(UC_ARM_REG_XPSR_NZCVQG, words[7]);
  cpu_.set(UC_ARM_REG_PC, words[6] | 1U);
  cpu_.refresh();
}

bool Exceptions::can_take(int number) const {
  if ((number == exception::kMemManage && !mem_manage_enabled) ||
      (number == exception::kBusFault && !bus_fault_enabled) ||
      (number == exception::kUsageFault && !usage_fault_enabled))
    return false;
  return level(number) < running_level(true);
}

std::optional<int> Exceptions::fault(int number, std::uint32_t cause) {
  cfsr |= cause;
  if (can_take(number)) return number;
  constexpr std::uint32_t kForced = 1U << 30;
  hfsr |= kForced;
  if (running_level(true) <= -1) return {};  // a fault at the priority of HardFault or above
  return exception::kHardFault;
}

}  // namespace astro::emulator
