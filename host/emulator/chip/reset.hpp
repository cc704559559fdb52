#pragma once

#include <array>
#include <cstdint>

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/chip/stored.hpp"

namespace astro::emulator {

/// The reset controller: why the chip started, and four words that survive every reset except power-on.
class Src : public Model {
 public:
  std::uint32_t read(std::uint32_t offset) override {
    return offset == teensy40::src::SRSR.value ? causes_ : kept_[word(offset)];
  }
  void write(std::uint32_t offset, std::uint32_t value) override {
    if (offset == teensy40::src::SRSR.value)
      causes_ &= ~value;
    else
      kept_[word(offset)] = value;
  }
  void reset() override {}

  void remember(Reset cause) {
    if (cause == Reset::power_on) {
      causes_ = 0;
      kept_ = {};
    }
    causes_ |= 1U << static_cast<unsigned>(cause);
  }

 private:
  static std::size_t word(std::uint32_t offset) { return (offset - teensy40::src::GPR5.value) / 4 % 4; }

  std::uint32_t causes_ = 0;
  std::array<std::uint32_t, 4> kept_{};
};

enum class FuseProblem { written };

/// The fuses: an identity that differs between robots.
class Ocotp : public Model {
 public:
  explicit Ocotp(Machine& machine, std::uint32_t identity) : machine_(machine), identity_(identity) {}
  std::uint32_t read(std::uint32_t offset) override {
    using namespace teensy40;
    if (offset == ocotp::CFG0.value) return 0x6A5B'0000 ^ identity_;
    if (offset == ocotp::CFG1.value) return 0x1C2D'3E4F + identity_;
    if (offset == ocotp::MAC0.value) return 0xE500'0000 | ((0x0A'1B2C + identity_) & 0xFF'FFFF);
    if (offset == ocotp::MAC1.value) return 0x04E9;
    return 0;  // CFG5: not locked to signed programs
  }
  void write(std::uint32_t, std::uint32_t) override {
    machine_.fail({"OCOTP: a fuse is written", FuseProblem::written});
  }
  void reset() override {}

 private:
  Machine& machine_;
  std::uint32_t identity_;
};

}  // namespace astro::emulator
