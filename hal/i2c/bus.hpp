#pragma once

#include <concepts>
#include <cstdint>
#include <span>

/// What a board gives to the sensors at its I2C bus.
namespace astro::i2c {

/// Where a transfer stands.
enum class Transfer : std::uint8_t {
  busy,
  done,
  refused,  // nobody acknowledged the address or a byte
  lost,     // the lines did not do what the controller did
};

/// A longer read would take more than the five ticks between two samples, at four bytes a tick.
inline constexpr std::uint8_t kMostBytes = 9;

/// An I2C bus with one controller, to which a sensor's registers are connected. Nothing waits: a transfer is begun, and then
/// advance() is called once a tick until it is no longer busy. Precondition of begin and release: no transfer is under way, unless
/// release() is to end it.
///   begin_read(address, from, count)     reads `count` registers, 1 to kMostBytes, which the sensor counts up by itself
///   begin_write(address, number, value)  writes one register
///   advance()    where the transfer stands
///   bytes()      what was read; valid once the transfer is done and until the next one
///   release()    ends whatever is under way, and clocks until nobody holds the data line any more: a sensor whose controller
///                was restarted in the middle of a byte waits for the rest of its clocks. advance() says when that is over: `done` if
///                both lines are free, `lost` if not
template <class T>
concept Bus = requires(T& bus, std::uint8_t byte) {
  { bus.begin_read(byte, byte, byte) }
  noexcept->std::same_as<void>;
  { bus.begin_write(byte, byte, byte) }
  noexcept->std::same_as<void>;
  { bus.advance() }
  noexcept->std::same_as<Transfer>;
  { bus.bytes() }
  noexcept->std::same_as<std::span<const std::uint8_t>>;
  { bus.release() }
  noexcept->std::same_as<void>;
};

}  // namespace astro::i2c
