#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/i2c/bus.hpp"

namespace astro::teensy40 {

/// The I2C bus on pins 18 (SDA) and 19 (SCL): LPI2C1 at 400 kHz, moved on by the tick without an interrupt. Its queues take four
/// words each way. While they are full or empty the controller holds the clock, which sensors allow.
///
/// Cost    advance(): two reads of the peripheral and one for each byte, at most four. release() moves one edge of the clock a tick.
class I2c {
 public:
  void start();

  void begin_read(std::uint8_t address, std::uint8_t from, std::uint8_t count) noexcept;
  void begin_write(std::uint8_t address, std::uint8_t number, std::uint8_t value) noexcept;
  i2c::Transfer advance() noexcept;
  std::span<const std::uint8_t> bytes() const noexcept { return {bytes_.data(), read_}; }
  void release() noexcept;

 private:
  void set_up();
  i2c::Transfer read_on();
  i2c::Transfer clock_on();

  std::array<std::uint8_t, i2c::kMostBytes> bytes_{};
  std::uint8_t wanted_ = 0, read_ = 0;
  bool stop_asked_ = false;
  int edges_left_ = 0;  // of release()
};

static_assert(i2c::Bus<I2c>);

}  // namespace astro::teensy40
