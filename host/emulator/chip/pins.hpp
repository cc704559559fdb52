#pragma once

#include <cstdint>
#include <functional>

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/chip/stored.hpp"
#include "host/emulator/memory.hpp"

namespace astro::emulator {

/// IOMUXC: what each pad is connected to. All pads are GPIO with a keeper after a reset.
class Iomuxc : public Stored {
 public:
  std::uint32_t function(std::uint32_t mux_offset) const {
    constexpr std::uint32_t kGpio = 5;
    const std::uint32_t word = value(mux_offset);
    return touched(mux_offset) ? word & 0xF : kGpio;
  }
  void write(std::uint32_t offset, std::uint32_t value) override { store(offset, value | kTouched); }
  std::uint32_t read(std::uint32_t offset) override { return value(offset) & ~kTouched; }
  std::uint32_t setting(std::uint32_t pad_offset) const {
    constexpr std::uint32_t kKeeper = 0x10B0;
    return touched(pad_offset) ? value(pad_offset) & ~kTouched : kKeeper;
  }
  std::uint32_t selection(std::uint32_t select_offset) const { return value(select_offset) & 7; }

 private:
  static constexpr std::uint32_t kTouched = 1U << 31;  // no register here has that bit
  bool touched(std::uint32_t offset) const { return (value(offset) & kTouched) != 0; }
};

/// IOMUXC_GPR. The memories are laid out once: the firmware must ask for what Memory has.
class IomuxcGpr : public Stored {
 public:
  explicit IomuxcGpr(Machine& machine)
      : Stored({{teensy40::iomuxc_gpr::GPR16.value, 0x0020'0003}}), machine_(machine) {}

  void write(std::uint32_t offset, std::uint32_t word) override {
    using namespace teensy40;
    constexpr std::uint32_t kBanks = 0xAAAA'AAAA | ((1U << (2 * (Memory::kItcmBytes / 32768))) - 1U);
    if (offset == iomuxc_gpr::GPR17.value && word != kBanks)
      machine_.fail("IOMUXC_GPR GPR17: the emulator has 4 banks of code and 12 of data");
    if (offset == iomuxc_gpr::GPR16.value && word != 0x0020'0007)
      machine_.fail("IOMUXC_GPR GPR16: the vectors of the next reset must stay with the ROM");
    store(offset, word);
  }
  /// Pins of GPIO1..4 that belong to the fast copy, GPIO6..9.
  std::uint32_t fast_pins(int slow_port) const {
    return value(teensy40::iomuxc_gpr::GPR26.value + 4 * static_cast<std::uint32_t>(slow_port - 1));
  }

 private:
  Machine& machine_;
};

/// One GPIO port. Which pins it has is up to GPR26..29: 1..4 and 6..9 are two views of the same pads.
class Gpio : public Model {
 public:
  Gpio(Machine& machine, const IomuxcGpr& gpr, int port) : machine_(machine), gpr_(gpr), port_(port) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void reset() override { data_ = direction_ = mask_ = status_ = 0; }

  /// Levels of the pins that are outputs.
  std::uint32_t driven() const { return data_ & direction_; }
  std::uint32_t outputs() const { return direction_; }
  /// What the world applies to the pins that are inputs.
  void set_inputs(std::uint32_t levels) { inputs_ = levels; }

 private:
  void set_data(std::uint32_t data, std::uint32_t touched);

  Machine& machine_;
  const IomuxcGpr& gpr_;
  int port_;
  std::uint32_t data_ = 0, direction_ = 0, mask_ = 0, status_ = 0, inputs_ = ~0U;
};

}  // namespace astro::emulator
