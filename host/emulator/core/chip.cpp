#include "host/emulator/core/chip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "host/base/bytes.hpp"
#include "host/emulator/core/register_names.hpp"

namespace astro::emulator {
namespace {

constexpr std::uint32_t kPrivatePeripherals = 0xE000'0000;
constexpr std::uint32_t kImageVectorTable = 0x6000'1000;
constexpr Cycles kEntry = 12;  // of an exception, from the core's manual

/// Causes in CFSR.
namespace cause {
constexpr std::uint32_t kFetchDenied = 1U << 0, kAccessDenied = 1U << 1 | 1U << 7;
constexpr std::uint32_t kFetchBusError = 1U << 8, kAccessBusError = 1U << 9 | 1U << 15;
constexpr std::uint32_t kUndefined = 1U << 16, kNotThumb = 1U << 17;
}  // namespace cause

// What the engine calls its exceptions.
constexpr std::uint32_t kSvcNumber = 2, kNeverExecuted = 3, kBreakpoint = 7, kReturn = 8, kBreakpointToo = 16;
constexpr std::uint16_t kCallHalfKay = 0xBEFB, kWaitForEvent = 0xBF20;  // bkpt #251, wfe

std::string digits(std::uint32_t address) { return fmt::format("0x{:08X}", address); }

}  // namespace

Chip::Chip(HandOver hand_over)
    : hand_over_(hand_over),
      cpu_(std::make_unique<Cpu>(
          memory_,
          Cpu::Hooks{[this] { return interrupted(); }, [this] { skip_to(std::min(next_event_, end_)); },
                     [this](std::uint32_t address, int bytes) {
                       if (address < kPrivatePeripherals) return bus_.read(address, bytes);
                       if (find_register(address) == nullptr || bytes != 4)
                         fail({name_of(address) + ": read of a register that is not modelled",
                               AccessProblem::not_modelled,
                               {name_of(address), "read"}});
                       return control_.read(address);
                     },
                     [this](std::uint32_t address, std::uint32_t value, int bytes) {
                       if (address < kPrivatePeripherals) return bus_.write(address, value, bytes);
                       if (find_register(address) == nullptr || bytes != 4)
                         fail({name_of(address) + ": a write of a register that is not modelled",
                               AccessProblem::not_modelled,
                               {name_of(address), "write"}});
                       control_.write(address, value);
                     },
                     [this](std::uint32_t number) {
                       on_exception(number);
                       return !failure_ && !exceptions_.violation && number != kNeverExecuted;
                     },
                     [this](std::uint32_t address) {
                       return address < Memory::kFlash || cached_flash_.stale(address) ||
                              !protection_.at(address).read;
                     }})),
      exceptions_(*cpu_, memory_, protection_) {
  control_.on_invalidate = [this](std::uint32_t address) { cached_flash_.drop(address); };
}

void Chip::start(Reset cause) {
  wakeups_.clear();
  next_event_ = kNever;
  exceptions_.reset();
  control_.reset();
  for (Model* model : models_) model->reset();
  cached_flash_.clear();
  remember_reset(cause);
  in_bootloader_ = false;
  boot();
}

/// The ROM either enters a function directly, or takes stack and entry from a vector table.
void Chip::boot() {
  if (flash_busy_)
    fail({"NOR flash: the boot ROM reads it while it is busy, and finds nothing",
          ChipProblem::image_in_busy_flash});
  auto entry = load<std::uint32_t>(memory_.at(kImageVectorTable + 4, 4), 0);
  for (const int reg :
       {UC_ARM_REG_PRIMASK, UC_ARM_REG_BASEPRI, UC_ARM_REG_FAULTMASK, UC_ARM_REG_IPSR, UC_ARM_REG_CONTROL})
    cpu_->set(reg, 0);
  cpu_->set(UC_ARM_REG_SP, 0);
  if ((entry & 1) == 0) {
    const auto vectors = memory_.at(entry, 8);
    if (vectors.empty()) return fail({"the image's entry is in no memory", ChipProblem::entry_in_no_memory});
    cpu_->set(UC_ARM_REG_SP, load<std::uint32_t>(vectors, 0));
    entry = load<std::uint32_t>(vectors, 4);
  }
  if (hand_over_ == HandOver::untidy) leave_rom_state();
  cpu_->set(UC_ARM_REG_LR, ~0U);
  cpu_->set(UC_ARM_REG_EPSR, 1U << 24);
  cpu_->set(UC_ARM_REG_PC, entry);
  cpu_->refresh();
}

void Chip::leave_rom_state() {
  constexpr std::uint32_t kRomStack = Memory::kOcram + 0x8000;
  const std::uint32_t main_stack = cpu_->get(UC_ARM_REG_SP);
  protection_.leave_rom_state();
  control_.leave_rom_state();
  for (Model* model : models_) model->leave_rom_state();
  for (int reg = UC_ARM_REG_R0; reg <= UC_ARM_REG_R12; ++reg) cpu_->set(reg, 0xDEAD'BEEF);
  cpu_->set(UC_ARM_REG_CONTROL, 2);  // SPSEL
  cpu_->set(UC_ARM_REG_SP, kRomStack);
  cpu_->set(UC_ARM_REG_MSP, main_stack);
  cpu_->set(UC_ARM_REG_BASEPRI, 0x10);
  cpu_->set(UC_ARM_REG_FAULTMASK, 1);
  reschedule();
}

void Chip::wake(Model& model, Cycles when) {
  const auto wakeup =
      std::find_if(wakeups_.begin(), wakeups_.end(), [&](const Wakeup& w) { return w.model == &model; });
  if (wakeup != wakeups_.end())
    wakeup->when = when;
  else
    wakeups_.push_back({&model, when});
  reschedule();
}

void Chip::reschedule() {
  next_event_ = control_.next_event();
  for (const Wakeup& wakeup : wakeups_) next_event_ = std::min(next_event_, wakeup.when);
}

void Chip::run_events() {
  while (next_event_ <= now()) {
    if (control_.next_event() <= now()) control_.event();
    for (std::size_t i = 0; i < wakeups_.size(); ++i)
      if (wakeups_[i].when <= now()) {
        wakeups_[i].when = kNever;
        wakeups_[i].model->event();
      }
    reschedule();
  }
}

void Chip::fail(const Remark& fault) {
  if (failure_) return;
  const std::uint32_t pc = cpu_->pc() & ~1U;
  const std::string name = symbols.name_at(pc);
  Remark stopped = fault;
  stopped.sentence += fmt::format(" (PC 0x{:08X}{}{}, {:.6f} s)", pc, name.empty() ? "" : " in ", name,
                                  static_cast<double>(now()) / static_cast<double>(kCyclesPerSecond));
  failure_.emplace(stopped, pc, name);
}

void Chip::restart(Reset cause) { restart_ = cause; }

std::span<std::uint8_t> Chip::dma(std::uint32_t address, std::uint32_t bytes) {
  const auto found = memory_.at(address, bytes);
  if (found.empty() || address >= Memory::kFlash || address < Memory::kDtcm) {
    fail({"a bus master goes to " + digits(address) + ", which is no RAM",
          ChipProblem::bus_master_outside_ram,
          {digits(address)}});
    return {};
  }
  if (control_.cached(address) || (bytes != 0 && control_.cached(address + bytes - 1))) {
    fail({"a bus master goes to " + digits(address) + ", which the processor caches",
          ChipProblem::bus_master_in_cached_memory,
          {digits(address)}});
    return {};
  }
  return found;
}

/// Called before each block of instructions: true if the engine must be stopped for something that is due.
bool Chip::interrupted() {
  return now() >= std::min(next_event_, end_) || restart_ || failure_ || in_bootloader_ ||
         exceptions_.violation || access_changed_ || exceptions_.due().has_value();
}

void Chip::take_exception() {
  const std::optional<int> number = exceptions_.due();
  if (!number) return;
  skipped_ += kEntry;
  if (!exceptions_.enter(*number)) lock_up();
}

void Chip::pend_fault(int number, std::uint32_t cause) {
  if (const std::optional<int> taken = exceptions_.fault(number, cause))
    exceptions_.pend(*taken);
  else
    lock_up();
}

void Chip::on_exception(std::uint32_t number) {
  if (number == kReturn) {
    exceptions_.leave(cpu_->pc() | 1U);
  } else if (number == kSvcNumber) {
    pend_fault(exception::kSvc, 0);
  } else if (number == kNeverExecuted) {  // the register space, and addresses above it
    pend_fault(exception::kMemManage, cause::kFetchDenied);
  } else if (number == kBreakpoint || number == kBreakpointToo) {
    std::uint16_t instruction = 0;
    if (const auto code = memory_.at(cpu_->pc() & ~1U, 2); !code.empty())
      instruction = load<std::uint16_t>(code, 0);
    if (instruction == kCallHalfKay)
      in_bootloader_ = true;
    else
      fail({"a breakpoint, which takes a Teensy to its boot loader whatever the motors do",
            ChipProblem::breakpoint});
  } else {
    fail({fmt::format("exception {} of the engine", number),
          ChipProblem::exception_of_engine,
          {std::to_string(number)}});
  }
}

void Chip::set_flash_busy(bool busy) {
  if (busy) cached_flash_.mark_stale([this](std::uint32_t address) { return control_.cached(address); });
  flash_busy_ = busy;
  access_changed_ = true;
}

void Chip::set_layout(const Memory::Layout& layout) {
  memory_.set_layout(layout);
  access_changed_ = true;
}

/// Tells the engine which accesses the MPU, the layout of FlexRAM and a busy flash allow.
void Chip::apply_access() {
  access_changed_ = false;
  const auto largest = memory_.largest(), present = memory_.ranges();
  for (std::size_t i = 0; i < largest.size(); ++i) apply_access(largest[i], present[i].bytes.size());
  std::vector<Protection::Span> traps = protection_.traps();
  if (cached_flash_.any()) traps.push_back({Memory::kFlash, Memory::kFlashBytes});
  cpu_->set_traps(traps);
}

void Chip::apply_access(const Memory::Range& range, std::size_t present_bytes) {
  const std::uint64_t end = std::uint64_t{range.base} + range.bytes.size();
  std::vector<std::uint64_t> edges = protection_.edges();
  edges.insert(edges.end(), {range.base, range.base + present_bytes, end});
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i] < range.base || edges[i] >= end || edges[i] == edges[i + 1]) continue;
    const auto base = static_cast<std::uint32_t>(edges[i]);
    Protection::Access access = protection_.page(base);
    access.write = access.write && range.writable;
    if (base - range.base >= present_bytes || (flash_busy_ && range.base == Memory::kFlash))
      access = {false, false, false};
    cpu_->allow(base, static_cast<std::uint32_t>(edges[i + 1] - edges[i]), access);
  }
}

void Chip::enter_fault(int number, std::uint32_t cause) {
  const std::optional<int> taken = exceptions_.fault(number, cause);
  if (!taken || !exceptions_.enter(*taken)) lock_up();
}

void Chip::bad_access() {
  const Cpu::BadAccess& bad = cpu_->bad_access();
  if (flash_busy_ && bad.address >= Memory::kFlash && !bad.write)
    return fail({fmt::format("NOR flash: {} is {} while the flash is busy", digits(bad.address),
                             bad.fetch ? "executed" : "read"),
                 bad.fetch ? ChipProblem::busy_flash_executed : ChipProblem::busy_flash_read,
                 {digits(bad.address)}});
  if (cached_flash_.stale(bad.address) && !bad.fetch)
    return fail({"data cache: " + digits(bad.address) +
                     " is read, whose line may have been fetched while the flash was busy",
                 ChipProblem::stale_cache_line,
                 {digits(bad.address)}});
  const Protection::Access allowed = protection_.at(bad.address);
  if (bad.fetch ? allowed.execute : bad.write ? allowed.write : allowed.read) {
    if (!bad.fetch) exceptions_.bfar = bad.address;
    enter_fault(exception::kBusFault, bad.fetch ? cause::kFetchBusError : cause::kAccessBusError);
  } else {
    if (!bad.fetch) exceptions_.mmfar = bad.address;
    enter_fault(exception::kMemManage, bad.fetch ? cause::kFetchDenied : cause::kAccessDenied);
  }
}

void Chip::bad_instruction(bool thumb) {
  const auto before = memory_.at((cpu_->pc() & ~1U) - 2, 2);
  const std::uint16_t instruction = before.empty() ? 0 : load<std::uint16_t>(before, 0);
  if (thumb && instruction == kWaitForEvent)
    return fail({"WFE is not modelled", ChipProblem::wait_for_event_not_modelled});
  enter_fault(exception::kUsageFault, thumb ? cause::kUndefined : cause::kNotThumb);
}

void Chip::run_cpu() {
  const Cpu::End end = cpu_->run();
  if (in_bootloader_ || failure_) return;
  if (end == Cpu::End::sleeping) sleep(end_);
  if (end == Cpu::End::bad_access) bad_access();
  if (end == Cpu::End::bad_instruction || end == Cpu::End::not_thumb)
    bad_instruction(end == Cpu::End::bad_instruction);
}

void Chip::skip_to(Cycles when) {
  if (when > now()) skipped_ += when - now();
}

void Chip::sleep(Cycles end) {
  while (!exceptions_.wakes() && !restart_ && !failure_) {
    if (next_event_ >= end) {
      skip_to(end);
      return;
    }
    skip_to(next_event_);
    run_events();
  }
}

void Chip::run_until(Cycles end) {
  end_ = end;
  while (now() < end && !in_bootloader_) {
    run_events();
    if (exceptions_.violation) fail(*exceptions_.violation);
    if (failure_) throw Stopped(*failure_);
    if (restart_) start(*std::exchange(restart_, std::nullopt));
    if (access_changed_) apply_access();
    take_exception();
    if (!exceptions_.violation) run_cpu();
  }
  if (failure_) throw Stopped(*failure_);
  if (in_bootloader_) skip_to(end);
}

}  // namespace astro::emulator
