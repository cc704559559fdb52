#pragma once

#include <array>
#include <cstdint>

#include "host/emulator/chip/clocks.hpp"

namespace astro::emulator {

/// Four timers that count down, and the first two as one of 64 bits.
class Pit : public Model {
 public:
  Pit(Machine& machine, const Ccm& ccm) : machine_(machine), ccm_(ccm) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  /// Time since channel 0 was started; 0 before.
  std::uint64_t lifetime_us() const {
    return (channels_[0].control & 1) != 0 ? (machine_.now() - channels_[0].began) / kCyclesPerMicrosecond
                                           : 0;
  }

  void event() override;
  void reset() override;

 private:
  struct Channel {
    std::uint32_t load = 0, control = 0;
    bool flag = false;
    Cycles began = 0;
    Cycles due = kNever;  // when it reaches zero, if it counts by itself and somebody wants to know
  };

  Cycles cycles_per_count() const;
  std::uint64_t counted(std::size_t n) const;  // zero crossings of the clock of channel n
  std::uint32_t current(std::size_t n) const;
  void set_control(std::size_t n, std::uint32_t value);
  void update();

  Machine& machine_;
  const Ccm& ccm_;
  std::array<Channel, 4> channels_{};
  bool disabled_ = true;
  std::uint32_t held_low_ = 0;
};

}  // namespace astro::emulator
