#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "hal/sim/flash_faults.hpp"
#include "host/emulator/core/machine.hpp"

namespace astro::emulator {

/// Which command the flash ignores, or must not receive. The value of outside_parameters is the address.
enum class FlashProblem { busy, not_write_enabled, outside_parameters, more_than_a_page };

/// The serial NOR flash of a Teensy 4.0 (W25Q16JV): commands and their times, over the memory that the
/// processor reads its program from. Programming clears bits, erasing sets all bits of a sector. Failures,
/// above all power cuts, are those of the simulated board's flash.
class FlashChip : public Model {
 public:
  struct Times {
    Cycles page = 400 * kCyclesPerMicrosecond, erase = 45'000 * kCyclesPerMicrosecond;
    /// What the data sheet allows at most.
    static Times slowest() { return {3'000 * kCyclesPerMicrosecond, 400'000 * kCyclesPerMicrosecond}; }
  };
  static constexpr std::uint32_t kParameters = 0x1F'0000, kParametersEnd = 0x1F'F000;

  FlashChip(Machine& machine, std::span<std::uint8_t> content) : machine_(machine), content_(content) {}

  // It has no registers, but takes part in events.
  std::uint32_t read(std::uint32_t) override { return 0; }
  void write(std::uint32_t, std::uint32_t) override {}
  void event() override { on_busy(false); }
  /// A reset of the processor does not end what the flash is doing.
  void reset() override {
    if (busy()) machine_.wake(*this, busy_until_);
  }

  Times times;
  bool busy() const { return machine_.now() < busy_until_; }

  void write_enable();
  /// The write enable latch stays set until programming or erasing is done.
  std::uint8_t status() const { return busy() ? 3 : enabled_ ? 2 : 0; }
  std::array<std::uint8_t, 3> identity();
  void erase_sector(std::uint32_t address);
  /// Programs at most a page; beyond the page's end the address wraps to its beginning.
  void program(std::uint32_t address, std::span<const std::uint8_t> bytes);

  /// Makes the power fail after so many more bytes have been programmed or erased. The chip does nothing from
  /// then on.
  void cut_power_after(std::uint64_t bytes, sim::Tear tear = sim::Tear::sharp) {
    faults_.cut_power_after(bytes, tear);
  }
  bool powered() const { return faults_.powered(); }
  void restore_power();
  std::uint64_t bytes_worked() const { return faults_.bytes_worked(); }

  /// The sectors of the robot's parameters.
  std::span<std::uint8_t> parameters() { return content_.subspan(kParameters, kParametersEnd - kParameters); }
  /// Called when work begins and when it is done.
  std::function<void(bool)> on_busy = [](bool) {};

 private:
  void refuse_while_busy();
  bool begin(std::uint32_t address, Cycles takes);

  Machine& machine_;
  std::span<std::uint8_t> content_;
  bool enabled_ = false;
  Cycles busy_until_ = 0;
  sim::FlashFaults faults_;
};

}  // namespace astro::emulator
