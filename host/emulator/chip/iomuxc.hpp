#pragma once

#include <cstdint>
#include <functional>

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/chip/stored.hpp"
#include "host/emulator/core/memory.hpp"

namespace astro::emulator {

/// IOMUXC: what each pad is connected to. All pads are GPIO with a keeper after a reset.
class Iomuxc : public Stored {
 public:
  std::uint32_t function(std::uint32_t mux_offset) const { return setting(mux_offset) & 0xF; }
  std::uint32_t setting(std::uint32_t offset) const {
    const std::uint32_t word = value(offset);
    return (word & kTouched) != 0 ? word & ~kTouched : after_reset(offset);
  }
  std::uint32_t selection(std::uint32_t select_offset) const { return setting(select_offset) & 7; }

  void write(std::uint32_t offset, std::uint32_t value) override { store(offset, value | kTouched); }
  std::uint32_t read(std::uint32_t offset) override { return setting(offset); }

 private:
  static constexpr std::uint32_t kTouched = 1U << 31;  // no register here has that bit
  /// Functions come first, electrical settings next, and then the selections of inputs.
  static std::uint32_t after_reset(std::uint32_t offset) {
    constexpr std::uint32_t kSettings = 0x204, kSelections = 0x3EC, kGpio = 5, kKeeper = 0x10B0;
    return offset < kSettings ? kGpio : offset < kSelections ? kKeeper : 0;
  }
};

/// What is wrong with the division of FlexRAM.
enum class FlexRamProblem { vectors_moved, size_unknown };

/// IOMUXC_GPR: how FlexRAM is divided, and which of two ports owns a pin.
class IomuxcGpr : public Stored {
 public:
  explicit IomuxcGpr(Machine& machine)
      : Stored({{teensy40::iomuxc_gpr::GPR16.value, 0x0020'0003}}), machine_(machine) {}

  void write(std::uint32_t offset, std::uint32_t word) override;
  void reset() override;
  /// Called when the firmware, or a reset, has changed the division.
  std::function<void(const Memory::Layout&)> on_layout = [](const Memory::Layout&) {};

  /// Pins of GPIO1..4 that belong to the fast copy, GPIO6..9.
  std::uint32_t fast_pins(int slow_port) const {
    return value(teensy40::iomuxc_gpr::GPR26.value + 4 * static_cast<std::uint32_t>(slow_port - 1));
  }

 private:
  Memory::Layout layout() const;

  Machine& machine_;
};

}  // namespace astro::emulator
