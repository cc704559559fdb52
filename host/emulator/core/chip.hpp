#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/emulator/core/bus.hpp"
#include "host/emulator/core/cpu.hpp"
#include "host/emulator/core/exceptions.hpp"
#include "host/emulator/core/memory.hpp"
#include "host/emulator/core/protection.hpp"
#include "host/emulator/core/symbols.hpp"
#include "host/emulator/core/system_control.hpp"

namespace astro::emulator {

/// The state that the boot ROM leaves behind. `untidy`: everything is in the worst state that no manual
/// excludes: MPU on, interrupts enabled and pending, every mask set, the process stack in use, USB still
/// attached.
enum class HandOver : std::uint8_t { tidy, untidy };

/// What the processor or a bus master cannot do. A value is the address, or an exception's number.
enum class ChipProblem {
  image_in_busy_flash,
  entry_in_no_memory,
  bus_master_outside_ram,
  bus_master_in_cached_memory,
  breakpoint,
  exception_of_engine,
  busy_flash_read,
  busy_flash_executed,
  stale_cache_line,
  wait_for_event_not_modelled
};

/// Processor, memories, interrupt controller and virtual time: the machine into which models are put.
class Chip : public Machine {
 public:
  explicit Chip(HandOver hand_over);

  Memory& memory() { return memory_; }
  Cpu& cpu() { return *cpu_; }
  Bus& bus() { return bus_; }
  /// The MPU.
  const Protection& protection() const { return protection_; }
  /// CFSR: what the last fault was.
  std::uint32_t fault_status() const { return exceptions_.cfsr; }
  /// Whether an exception is pending.
  bool pending(int number) const { return exceptions_.pending(number); }

  /// Adds a model, which takes part in resets and events from now on.
  void add(Model& model) { models_.push_back(&model); }

  /// The names of addresses in messages.
  Symbols symbols;
  /// Whether a clock gate is open; where the cause of a reset is stored.
  std::function<bool(Gate)> gates;
  std::function<void(Reset)> remember_reset;
  /// Tells that the flash begins (true) or ends (false) to erase or program; in between it cannot be read.
  void set_flash_busy(bool busy);
  /// Changes the division of FlexRAM.
  void set_layout(const Memory::Layout& layout);

  /// Power-on or restart: resets the models, then runs the boot ROM.
  void start(Reset cause);

  /// Runs until `end`. Throws Stopped if the firmware broke a rule.
  void run_until(Cycles end);

  /// Whether the firmware has called the boot loader; the processor is stopped then.
  bool in_bootloader() const { return in_bootloader_; }

  // Machine
  Cycles now() const override { return skipped_ + cpu_->instructions(); }
  void set_interrupt(int irq, bool level) override { exceptions_.set_line(irq, level); }
  void wake(Model& model, Cycles when) override;
  void fail(const Remark& fault) override;
  bool clocked(Gate gate) const override { return gates(gate); }
  void wait(Cycles time) override { skipped_ += time; }
  bool runs_from_flash() const override { return cpu_->pc() >= Memory::kFlash; }
  std::span<std::uint8_t> dma(std::uint32_t address, std::uint32_t bytes) override;
  void restart(Reset cause) override;

 private:
  bool interrupted();
  void run_events();
  void reschedule();
  void run_cpu();
  void sleep(Cycles end);
  void take_exception();
  void on_exception(std::uint32_t number);
  void pend_fault(int number, std::uint32_t cause);
  void skip_to(Cycles when);
  void bad_access();
  void bad_instruction(bool thumb);
  void enter_fault(int number, std::uint32_t cause);
  void apply_access();
  void apply_access(const Memory::Range& range, std::size_t present_bytes);
  void lock_up() { restart(Reset::software); }
  void boot();
  void leave_rom_state();

  struct Wakeup {
    Model* model;
    Cycles when;
  };

  HandOver hand_over_;
  Memory memory_;
  Bus bus_{*this};
  std::unique_ptr<Cpu> cpu_;
  Protection protection_{*this, [this] { access_changed_ = true; }};
  Exceptions exceptions_;
  SystemControl control_{*this, exceptions_, protection_};
  std::vector<Model*> models_;
  std::vector<Wakeup> wakeups_;
  Cycles skipped_ = 0;  // time in which no instruction ran
  Cycles next_event_ = kNever, end_ = 0;
  CachedFlash cached_flash_;
  std::optional<Stopped> failure_;
  std::optional<Reset> restart_;
  bool in_bootloader_ = false, flash_busy_ = false, access_changed_ = true;
};

}  // namespace astro::emulator
