#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "hal/interface/board.hpp"
#include "hal/mock/flash.hpp"
#include "hal/mock/ports.hpp"

/// A board without a world: a test sets every input and reads every output. Nothing happens by itself; even
/// time passes only when the test sets it.
namespace astro::mock {

enum class Bridge : std::uint8_t { coast, brake, drive };

/// H-bridges without motors, which remember the calls.
struct Motors {
  Bridge state = Bridge::coast;
  hal::Duty duty;  // of the last drive(); brake() and coast() do not change it
  bool faulted = false;
  int drives = 0, brakes = 0, coasts = 0;  // calls so far

  void drive(hal::Duty wanted) noexcept {
    state = Bridge::drive;
    duty = wanted;
    ++drives;
  }
  void brake() noexcept {
    state = Bridge::brake;
    ++brakes;
  }
  void coast() noexcept {
    state = Bridge::coast;
    ++coasts;
  }
  bool fault() noexcept { return faulted; }
};

struct Clock {
  std::uint64_t time_us = 0;
  std::uint64_t now_us() const noexcept { return time_us; }
};

struct Encoders {
  hal::EncoderCounts counts;
  hal::EncoderCounts read() noexcept { return counts; }
};

struct Gyro {
  hal::GyroReading reading;  // absent until a test sets it
  hal::GyroReading read() noexcept { return reading; }
};

struct Battery {
  std::int32_t supply_mV = 12000;
  std::int32_t millivolts() noexcept { return supply_mV; }
};

/// Rebooting and entering the bootloader coast the motors, as on every board, and are counted.
struct System {
  explicit System(Motors& bridges) : motors(bridges) {}

  Motors& motors;
  std::array<std::uint8_t, 16> id{0x4D, 0x4F, 0x43, 0x4B};
  hal::ResetCause cause = hal::ResetCause::power_on;
  bool has_bootloader = true;
  bool bootloader_wanted = false;  // set it to ask for the bootloader without the protocol
  int reboots = 0, bootloader_entries = 0, watchdog_feeds = 0;  // calls so far

  std::array<std::uint8_t, 16> unique_id() noexcept { return id; }
  std::string_view name() noexcept { return "mock"; }
  hal::ResetCause reset_cause() noexcept { return cause; }
  void reboot() noexcept {
    motors.coast();
    ++reboots;
  }
  bool enter_bootloader() noexcept {
    if (!has_bootloader) return false;
    motors.coast();
    ++bootloader_entries;
    return true;
  }
  bool host_wants_bootloader() noexcept { return std::exchange(bootloader_wanted, false); }
  void feed_watchdog() noexcept { ++watchdog_feeds; }
};

class Board {
 public:
  Board() : system_(motors_) {}
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  Clock& clock() { return clock_; }
  Encoders& encoders() { return encoders_; }
  Motors& motors() { return motors_; }
  Battery& battery() { return battery_; }
  Gyro& gyro() { return gyro_; }
  Ports& ports() { return ports_; }
  Flash& flash() { return flash_; }
  System& system() { return system_; }

  /// Counts the guards that live, so that a test can see what runs while the tick is held.
  class [[nodiscard]] Hold {
   public:
    explicit Hold(int& depth) : depth_(depth) { ++depth_; }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    ~Hold() { --depth_; }

   private:
    int& depth_;
  };
  Hold hold_tick() { return Hold(held_); }
  bool tick_is_held() const { return held_ > 0; }

 private:
  Clock clock_;
  Encoders encoders_;
  Motors motors_;
  Battery battery_;
  Gyro gyro_;
  Ports ports_;
  Flash flash_;
  System system_;
  int held_ = 0;
};

static_assert(hal::Board<Board> && hal::HasGyro<Board>, "this port no longer satisfies hal/interface");

}  // namespace astro::mock
