#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "host/base/error.hpp"

/// The interfaces between the machine and the models of the chip's peripherals, and how a run ends.
namespace astro::emulator {

/// Virtual time in cycles of the 600 MHz core. Every instruction takes one cycle: the emulator proves order
/// and counts instructions; it does not model caches, buses or flash timing.
using Cycles = std::uint64_t;
inline constexpr Cycles kCyclesPerSecond = 600'000'000;
inline constexpr Cycles kCyclesPerMicrosecond = 600;
inline constexpr Cycles kNever = ~Cycles{0};

/// A clock gate: field CG`index` of CCGR`reg`.
struct Gate {
  int reg, index;
};

/// Why the chip restarts; bit numbers of SRC_SRSR.
enum class Reset : std::uint8_t { power_on = 0, software = 1, pin = 3, watchdog = 7 };

class Model;

/// The machine as a model sees it. Models are called on one thread, in virtual time.
class Machine {
 public:
  virtual ~Machine() = default;

  virtual Cycles now() const = 0;

  /// Sets the level of an interrupt line (0..159).
  virtual void set_interrupt(int irq, bool level) = 0;

  /// Calls model.event() at `when`, replacing an earlier request of the same model; kNever cancels it.
  virtual void wake(Model& model, Cycles when) = 0;

  /// Ends the run because the firmware did something that fails on the chip. The sentence of `fault` names
  /// the register and the rule; the machine adds PC and time. May be called anywhere; later calls are
  /// ignored.
  virtual void fail(const Remark& fault) = 0;

  /// True while the gate lets the clock through in run mode.
  virtual bool clocked(Gate gate) const = 0;

  /// Makes the processor wait for this time because a peripheral answers late.
  virtual void wait(Cycles time) = 0;

  /// True while the instructions come from the flash, where any fetch may take a microsecond.
  virtual bool runs_from_flash() const = 0;

  /// Memory for a bus master. If the range is not RAM, calls fail() and returns nothing. The same if the
  /// processor caches it (the firmware's MPU setting decides), because a real master would see stale data.
  virtual std::span<std::uint8_t> dma(std::uint32_t address, std::uint32_t bytes) = 0;

  /// Restarts the chip at the end of the present instruction. RAM keeps its content, as on the chip.
  virtual void restart(Reset cause) = 0;
};

/// One peripheral. Offsets are from its base. The machine has already checked each access against the widths
/// in hal/teensy40/registers and the peripheral's clock gate; an offset without a row there never arrives.
class Model {
 public:
  virtual ~Model() = default;

  virtual std::uint32_t read(std::uint32_t offset) = 0;
  virtual void write(std::uint32_t offset, std::uint32_t value) = 0;

  /// Called when the time requested by Machine::wake has come.
  virtual void event() {}

  /// Sets reset values, whatever the cause. A model keeps what survives a warm reset.
  virtual void reset() = 0;
  /// After reset(): what a boot ROM may have done to it before the program begins.
  virtual void leave_rom_state() {}
};

/// The run has ended because the firmware did something that fails on the chip. The message names the
/// register and the rule, the program counter and the time; kind and values are those of the model.
class Stopped : public Error {
 public:
  /// `function`: the one at the program counter, with the offset in it; "" if there is no symbol.
  Stopped(const Remark& fault, std::uint32_t pc, std::string function)
      : Error(fault), pc_(pc), function_(std::move(function)) {}

  std::uint32_t pc() const { return pc_; }
  const std::string& function() const { return function_; }

 private:
  std::uint32_t pc_;
  std::string function_;
};

}  // namespace astro::emulator
