#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "host/emulator/robot/teensy.hpp"

namespace astro::target {

/// Instructions that the main loop spends in one go while it holds the control tick: with BASEPRI raised, as
/// hold_tick() does. Not counted is the flash driver, which switches all interrupts off for the 71 us in
/// which a page goes over the wire: the firmware writes flash only at rest.
class HeldTick {
 public:
  explicit HeldTick(emulator::Teensy& teensy) : cpu_(teensy.chip().cpu()) {
    cpu_.trace = [this](std::uint32_t, std::uint32_t instructions) { look(instructions); };
  }
  ~HeldTick() { cpu_.trace = nullptr; }
  HeldTick(const HeldTick&) = delete;
  HeldTick& operator=(const HeldTick&) = delete;

  /// The longest since the last call.
  std::uint32_t take_longest() { return std::exchange(longest_, 0); }
  /// How often the tick was held since construction.
  std::uint64_t holds() const { return holds_; }

 private:
  static constexpr std::uint32_t kTickPriority = 2U << 4;  // urgency::kTick as BASEPRI holds it

  void look(std::uint32_t instructions) {
    if ((cpu_.get(UC_ARM_REG_IPSR) & 0x1FF) != 0) return;
    const std::uint32_t base = cpu_.get(UC_ARM_REG_BASEPRI);
    const bool held = base != 0 && base <= kTickPriority;
    if (held) {
      holds_ += now_ == 0 ? 1 : 0;
      now_ += instructions;
      longest_ = std::max(longest_, now_);
    } else {
      now_ = 0;
    }
  }

  emulator::Cpu& cpu_;
  std::uint32_t now_ = 0, longest_ = 0;
  std::uint64_t holds_ = 0;
};

}  // namespace astro::target
