#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "common/base/nor_flash.hpp"

/// What a board gives to the firmware. These are concepts, not base classes: a binary has one board, so the
/// control interrupt needs no indirection. Each port ends in `static_assert(hal::Board<Board>)`.
///
/// The comments are the contract; tests/contract checks every port against it.
namespace astro::hal {

/// Running counts of both quadrature decoders, read at one instant. Each wraps at 2^32, so the difference of
/// two readings is exact if they are less than 2^31 counts apart. The sign is the decoder's own: the polarity
/// parameters, not the board, make forward positive.
struct EncoderCounts {
  std::int32_t left = 0;
  std::int32_t right = 0;
};

/// Duty of both H-bridges as a fraction of the bus voltage, Q15: +-32767 is full drive, the sign is the
/// direction.
struct Duty {
  std::int16_t left = 0;
  std::int16_t right = 0;
  friend constexpr bool operator==(const Duty&, const Duty&) = default;
};

/// Why the processor last started.
enum class ResetCause : std::uint8_t { power_on, software, watchdog, fault, pin, unknown };

/// Monotonic microseconds since power-on; 64 bits never wrap. Callable from tick and main loop.
template <class T>
concept Clock = requires(const T& clock) {
  { clock.now_us() }
  noexcept->std::same_as<std::uint64_t>;
};

template <class T>
concept Encoders = requires(T& encoders) {
  { encoders.read() }
  noexcept->std::same_as<EncoderCounts>;
};

/// Two H-bridges. At power-on both coast.
///   drive(d)   drives both; replaces brake and coast
///   brake()    shorts both motors, so that they resist turning
///   coast()    opens both bridges; allowed at any time from any context, so every failure can end in it
///   fault()    true while the driver reports over-current or over-temperature
template <class T>
concept Motors = requires(T& motors, Duty duty) {
  { motors.drive(duty) }
  noexcept->std::same_as<void>;
  { motors.brake() }
  noexcept->std::same_as<void>;
  { motors.coast() }
  noexcept->std::same_as<void>;
  { motors.fault() }
  noexcept->std::same_as<bool>;
};

/// Voltage of the motor supply, filtered to a bandwidth of about 100 Hz or less. Callable from the tick.
template <class T>
concept Battery = requires(T& battery) {
  { battery.millivolts() }
  noexcept->std::same_as<std::int32_t>;
};

/// `kPorts` byte streams to hosts (USB CDC, UART, pty). All carry the same protocol. Main loop only.
///   read(port, into)    moves the bytes that have arrived, at most into.size(), and returns their number;
///                       never blocks
///   write(port, bytes)  takes as many bytes as there is room for and returns their number; never blocks, so
///                       a host that does not read cannot stop the robot
///   room(port)          the number of bytes that write would take now
template <class T>
concept Ports = requires(T& ports, int port, std::span<std::uint8_t> into,
                         std::span<const std::uint8_t> bytes) {
  { T::kPorts } -> std::convertible_to<int>;
  { ports.read(port, into) }
  noexcept->std::same_as<std::size_t>;
  { ports.write(port, bytes) }
  noexcept->std::same_as<std::size_t>;
  { ports.room(port) }
  noexcept->std::same_as<std::size_t>;
};

/// The NOR flash that keeps parameters and fault log, as common/base/nor_flash.hpp describes it; four sectors
/// or more. Main loop only. Erase and program only while the robot is at rest, because the processor may
/// stand still for a whole erase.
template <class T>
concept Flash = NorFlash<T> && T::kSectors >= 4;

/// The processor itself.
///   unique_id()        128 bits that no other robot has; the same at every start
///   name()             board name, at most 23 ASCII characters, e.g. "sim", "teensy40"
///   reset_cause()      why the processor last started
///   reboot()           coasts, then restarts; does not return on hardware
///   enter_bootloader() coasts, then waits for new firmware; does not return on hardware. False if the board
///                      cannot do it
///   host_wants_bootloader()
///                      true once after a host has asked for the bootloader without the protocol, in the way
///                      of this kind of board (a Teensy: by setting 134 baud)
///   feed_watchdog()    called only when every task has checked in
template <class T>
concept System = requires(T& system) {
  { system.unique_id() }
  noexcept->std::same_as<std::array<std::uint8_t, 16>>;
  { system.name() }
  noexcept->std::same_as<std::string_view>;
  { system.reset_cause() }
  noexcept->std::same_as<ResetCause>;
  { system.reboot() }
  noexcept->std::same_as<void>;
  { system.enter_bootloader() }
  noexcept->std::same_as<bool>;
  { system.host_wants_bootloader() }
  noexcept->std::same_as<bool>;
  { system.feed_watchdog() }
  noexcept->std::same_as<void>;
};

/// What a rate gyro measured last.
struct GyroReading {
  enum class State : std::uint8_t {
    absent,    // nothing answers, or what answers is no gyro that the board knows
    starting,  // it is being set up
    running,
    failed,  // it has answered before and does not any more; the board tries to start it again
  };
  static constexpr std::int16_t kNoTemperature = INT16_MIN;
  static constexpr std::int16_t kSaturated = 32'000;  // a rate of so many counts may be any rate beyond

  State state = State::absent;
  std::int16_t temperature_cC = kNoTemperature;  // 0.01 degrees Celsius
  std::array<std::int16_t, 3> rate{};            // about the sensor's own axes x, y and z, counts
  std::uint32_t count_nradps = 0;                // what a count is, 1e-9 rad/s
  std::uint32_t number = 0;  // of the sample, wraps: another one for each, also of one that repeats itself
};

/// Without the call of a library that a comparison of arrays is.
constexpr bool same_rate(const std::array<std::int16_t, 3>& a, const std::array<std::int16_t, 3>& b) {
  return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
}

/// A rate gyro of three axes, fixed to the robot's body in any way. Optional: a board without one has no `gyro()`, and then
/// its firmware no code for it, or one that says `absent`.
///   read()  the newest sample. Never waits, and begins the fetching of the next one if the board has to do that. Tick only, and
///           in each tick at most once, because a board may count its time in calls
template <class T>
concept Gyro = requires(T& gyro) {
  { gyro.read() }
  noexcept->std::convertible_to<const GyroReading&>;
};

/// A board with a gyro.
template <class T>
concept HasGyro = requires(T& board) {
  requires Gyro<std::remove_reference_t<decltype(board.gyro())>>;
};

/// A whole board. `hold_tick()` returns a guard for the main loop: while the guard lives the control tick
/// does not run, so the main loop can use what it shares with the tick. Keep it for microseconds, never
/// during I/O. The guard cannot be copied.
template <class T>
concept Board = requires(T& board) {
  requires Clock<std::remove_reference_t<decltype(board.clock())>>;
  requires Encoders<std::remove_reference_t<decltype(board.encoders())>>;
  requires Motors<std::remove_reference_t<decltype(board.motors())>>;
  requires Battery<std::remove_reference_t<decltype(board.battery())>>;
  requires Ports<std::remove_reference_t<decltype(board.ports())>>;
  requires Flash<std::remove_reference_t<decltype(board.flash())>>;
  requires System<std::remove_reference_t<decltype(board.system())>>;
  board.hold_tick();
};

/// The guard that `hold_tick()` returns. Code that gets one knows that the control tick does not run.
template <class Board>
using TickHold = decltype(std::declval<Board&>().hold_tick());

}  // namespace astro::hal
