#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

/// What a board gives to the firmware. Concepts, not base classes: one board per binary, no indirection in
/// the control interrupt, and each port ends in `static_assert(hal::Board<Board>)`.
///
/// The words beside each call are the contract; tests/contract holds every port to them.
namespace astro::hal {

/// Running counts of both quadrature decoders, read at one instant. Each wraps at 2^32, so the difference of
/// two readings less than 2^31 counts apart is exact. Positive counts are the decoder's own sense: the
/// polarity parameters, not the board, make forward positive.
struct EncoderCounts {
  std::int32_t left = 0;
  std::int32_t right = 0;
};

/// Duty of both H-bridges as a fraction of the bus voltage, Q15: +-32767 is full drive, sign is direction.
struct Duty {
  std::int16_t left = 0;
  std::int16_t right = 0;
  friend constexpr bool operator==(const Duty&, const Duty&) = default;
};

/// Why the processor last started.
enum class ResetCause : std::uint8_t { power_on, software, watchdog, fault, pin, unknown };

/// Monotonic microseconds since power-on. 64 bits: never wraps. Callable from tick and main loop.
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
///   brake()    shorts both motors: they resist turning
///   coast()    opens both bridges; always legal, from any context, and the state to fall back to
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

/// Byte streams to hosts (USB CDC, UART, pty): `kPorts` of them, all carrying the same protocol. Main loop
/// only.
///   read(port, into)    moves what has arrived, at most into.size(); 0 if nothing. Never blocks.
///   write(port, bytes)  takes as many as there is room for and returns that number. Never blocks; a host
///   that
///                       does not read never stops the robot.
///   room(port)          bytes that write would take now
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

/// NOR flash set aside for parameters and fault log: `kSectors` sectors of `kSectorBytes`, four at least.
/// Main loop only; erase and program with the robot at rest: the processor may stand still for a whole erase.
///   erase(sector)            every byte of the sector becomes 0xFF
///   program(offset, bytes)   clears bits: the result is old AND new. offset and size are multiples of
///                            kProgramBytes and stay within one sector.
///   read(offset, into)
/// erase and program return false if a read-back differs; a power cut leaves any mixture of old and new bits
/// in the bytes under way, and no others.
template <class T>
concept Flash = requires(T& flash, std::uint32_t at, std::span<std::uint8_t> into,
                         std::span<const std::uint8_t> bytes) {
  { T::kSectors } -> std::convertible_to<std::uint32_t>;
  { T::kSectorBytes } -> std::convertible_to<std::uint32_t>;
  { T::kProgramBytes } -> std::convertible_to<std::uint32_t>;
  { flash.erase(at) }
  noexcept->std::same_as<bool>;
  { flash.program(at, bytes) }
  noexcept->std::same_as<bool>;
  { flash.read(at, into) }
  noexcept->std::same_as<void>;
};

/// The processor itself.
///   unique_id()        128 bits that no other robot has; the same at every start
///   name()             board name, at most 23 ASCII characters, e.g. "sim", "teensy40"
///   reset_cause()      why this start happened
///   reboot()           coasts, then restarts; on hardware does not return
///   enter_bootloader() coasts, then waits for new firmware; on hardware does not return. False: not
///                      supported
///   host_wants_bootloader()  true once after a host asked for new firmware past the protocol, by the means
///                      that this kind of board has for it (a Teensy: 134 baud); granted only when disarmed
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

/// A whole board. `hold_tick()` returns a guard for the main loop: while it lives the control tick does not
/// run, so that the two share data. Hold it for microseconds, never around I/O.
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

}  // namespace astro::hal
