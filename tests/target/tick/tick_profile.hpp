#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "host/emulator/robot/teensy.hpp"

namespace astro::target {

/// Instructions of the control tick by what they are for, counted on the image that is flashed. An
/// instruction belongs to the innermost function, inlined or not, that has a part's name in the table of
/// tick_profile.cpp.
class TickProfile {
 public:
  enum Part : std::uint8_t {
    encoders,
    speed,
    control,
    odometry,
    safety,
    pwm,
    motion,
    gyro,
    clock,
    battery,
    rest,
    kParts
  };
  static constexpr std::array<const char*, kParts> kNames{"encoders", "speed",   "control", "odometry",
                                                          "safety",   "PWM",     "motion",  "gyro",
                                                          "clock",    "battery", "rest"};

  /// Counts every tick of `teensy` from now on.
  TickProfile(emulator::Teensy& teensy, const std::string& elf);
  ~TickProfile() { teensy_.chip().cpu().trace = nullptr; }
  TickProfile(const TickProfile&) = delete;
  TickProfile& operator=(const TickProfile&) = delete;

  struct Cost {
    std::uint32_t worst = 0;
    double mean = 0;
  };
  std::uint64_t ticks() const { return ticks_; }
  Cost part(Part part) const { return cost(part); }
  Cost whole() const { return cost(kParts); }
  /// What the budget is about: control, odometry and safety of the same tick.
  Cost budgeted() const { return cost(kParts + 1); }
  /// `bar`: what the budget allows.
  void print(std::uint32_t bar) const;

 private:
  using Counts = std::array<std::uint32_t, kParts>;

  Cost cost(std::size_t row) const;
  const Counts& counts_of(std::uint32_t address, std::uint32_t instructions);
  void finish();

  emulator::Teensy& teensy_;
  std::vector<Part> part_of_;  // by halfword of code memory
  std::map<std::pair<std::uint32_t, std::uint32_t>, Counts> blocks_;
  Counts now_{};
  bool in_tick_ = false;
  std::uint64_t ticks_ = 0;
  std::array<std::uint32_t, kParts + 2> longest_{};  // the parts of the longest tick
  std::array<std::uint32_t, kParts + 2> worst_{};
  std::array<std::uint64_t, kParts + 2> sum_{};
};

}  // namespace astro::target
