#pragma once

#include <cstdint>
#include <span>
#include <string>

/// What the models of the chip's parts and the machine that holds them know of one another.
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

/// Why the chip starts again; bit numbers of SRC_SRSR.
enum class Reset : std::uint8_t { power_on = 0, software = 1, pin = 3, watchdog = 7 };

class Model;

/// The machine as a model sees it. Models are called on one thread, in virtual time.
class Machine {
 public:
  virtual ~Machine() = default;

  virtual Cycles now() const = 0;

  /// The level of an interrupt line (0..159).
  virtual void set_interrupt(int irq, bool level) = 0;

  /// Calls model.event() at `when`, replacing an earlier wish of the same model; kNever takes it back.
  virtual void wake(Model& model, Cycles when) = 0;

  /// Ends the run: the firmware did something that the chip would not forgive. `what` names the register and
  /// the rule; the machine adds PC and time. May be called anywhere; what follows is ignored.
  virtual void fail(const std::string& what) = 0;

  /// True while the gate lets the clock through in run mode.
  virtual bool clocked(Gate gate) const = 0;

  /// The processor waits so long for a peripheral that answers late.
  virtual void wait(Cycles time) = 0;

  /// True while the instructions come from the flash, where any fetch may take a microsecond.
  virtual bool runs_from_flash() const = 0;

  /// Memory for a bus master. Empty after fail() if the range is no RAM, or RAM that the processor caches
  /// (the firmware's MPU setting decides), where a real master would see stale data.
  virtual std::span<std::uint8_t> dma(std::uint32_t address, std::uint32_t bytes) = 0;

  /// The chip starts again once the instruction under way is over. RAM keeps its content, as on the chip.
  virtual void restart(Reset cause) = 0;
};

/// One peripheral. Offsets are from its base. The machine has already held the access to the widths of
/// hal/teensy40/registers and to the peripheral's clock gate; an offset without a row there never arrives.
class Model {
 public:
  virtual ~Model() = default;

  virtual std::uint32_t read(std::uint32_t offset) = 0;
  virtual void write(std::uint32_t offset, std::uint32_t value) = 0;

  /// The time asked for by Machine::wake has come.
  virtual void event() {}

  /// Reset values, whatever the cause. What survives a warm reset is the model's to keep.
  virtual void reset() = 0;
  /// After reset(): what a boot ROM may have done to it before the program begins.
  virtual void leave_rom_state() {}
};

}  // namespace astro::emulator
