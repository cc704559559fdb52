#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "hal/interface/board.hpp"
#include "hal/sim/motors.hpp"
#include "hal/sim/noise.hpp"

namespace astro::sim {

/// Virtual time since the firmware started; it advances with the control tick only.
class Clock {
 public:
  std::uint64_t now_us() const noexcept { return now_us_; }
  void advance_us(std::uint64_t us) { now_us_ += us; }
  void restart() { now_us_ = 0; }

 private:
  std::uint64_t now_us_ = 0;
};

/// The processor. A simulated processor cannot stop in the middle of a function, so reboot() and
/// enter_bootloader() coast and leave a request that the owner of the board takes.
class System {
 public:
  /// `identity`: what decides the unique id.
  System(std::uint64_t identity, const Clock& clock, Motors& motors) : clock_(clock), motors_(motors) {
    for (std::size_t i = 0; i < id_.size(); ++i)
      id_[i] = static_cast<std::uint8_t>(hash(identity, kIdStream, i / 8) >> (i % 8 * 8));
  }

  std::array<std::uint8_t, 16> unique_id() noexcept { return id_; }
  std::string_view name() noexcept { return "sim"; }
  hal::ResetCause reset_cause() noexcept { return cause_; }
  void reboot() noexcept {
    motors_.coast();
    reboot_requested_ = true;
  }
  bool enter_bootloader() noexcept {
    motors_.coast();
    bootloader_requested_ = true;
    return true;
  }
  bool host_wants_bootloader() noexcept { return false; }  // there is no way but the protocol
  void feed_watchdog() noexcept { fed_us_ = clock_.now_us(); }

  /// True once for each request.
  bool take_reboot_request() { return std::exchange(reboot_requested_, false); }
  bool take_bootloader_request() { return std::exchange(bootloader_requested_, false); }

  /// Time since the watchdog was fed, or since the start.
  std::uint64_t since_fed_us() const { return clock_.now_us() - fed_us_; }

  void restart(hal::ResetCause cause) {
    cause_ = cause;
    fed_us_ = 0;
    reboot_requested_ = bootloader_requested_ = false;
  }

 private:
  static constexpr std::uint64_t kIdStream = 0x1D;  // wheels use 0 and 1

  const Clock& clock_;
  Motors& motors_;
  std::array<std::uint8_t, 16> id_{};
  hal::ResetCause cause_ = hal::ResetCause::power_on;
  std::uint64_t fed_us_ = 0;
  bool reboot_requested_ = false, bootloader_requested_ = false;
};

}  // namespace astro::sim
