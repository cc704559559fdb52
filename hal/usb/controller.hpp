#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/usb/descriptors.hpp"
#include "hal/usb/setup.hpp"

/// What a board's device controller gives to the serial port.
namespace astro::usb_device {

/// An endpoint in one direction: `in` is towards the host.
struct Pipe {
  std::uint32_t endpoint;
  bool in;

  constexpr std::uint32_t bit() const { return 1U << (endpoint + (in ? 16 : 0)); }
  constexpr std::uint32_t index() const { return 2 * endpoint + (in ? 1 : 0); }
};

/// What has happened on the bus since the last question.
struct Events {
  bool reset;      // the bus is in reset
  bool suspended;  // or the cable is out
  bool resumed;
  bool transfers;
};

/// A device controller at register level, with one transfer under way for each pipe. A chip has one, so all functions are
/// static.
///   kIdentity, kBootloaderBaud  what the device is; the baud rate by which hosts ask this kind of board for its boot loader
///   InterruptOff     the controller's interrupt waits while such an object lives; they do not nest
///   install(handler) `handler` runs for the controller's interrupt
///   now_us()         the board's clock
///   power_down()     leaves the bus in any state of the controller: the program before may have left it attached
///   start()          clocks, transceiver and controller; attaches to the bus
///   detach()         leaves the bus
///   take_events()    returns the pending events and clears them
///   clean_up_after_reset()  on a bus reset: drops all transfers. False if the reset is already over, which is too late
///   speed()
///   set_address(address)    the device has it from the end of the next transfer to the host at endpoint 0
///   open_endpoints(speed), close_endpoints()  sets up the robot's three endpoints, or removes them; drops their transfers
///   stall(pipe), unstall(pipe), stall_control()  the next SETUP packet ends the last of them by itself
///   take_setup(setup)  true if a SETUP packet has arrived; transfers at endpoint 0 are then dropped
///   setup_waits()      a SETUP packet waits; no transfer may be started at endpoint 0 before it has been taken
///   begin(pipe, bytes) starts a transfer. The bytes must stay in place until it is over. If the bulk endpoint sends a
///                      multiple of full packets to the host, an empty packet follows, because the host would otherwise
///                      wait for more
///   cancel(pipe)       drops the transfer of a pipe, even if it has just ended
///   take_completed()   pipes whose transfers have ended since the last call, a bit each
///   moved(pipe)        bytes moved by the last transfer of a pipe
template <class C>
concept Controller = requires(Setup& setup, Pipe pipe, std::span<std::uint8_t> bytes, std::uint8_t address,
                              Speed speed, void (*handler)()) {
  { C::kIdentity } -> std::convertible_to<Identity>;
  { C::kBootloaderBaud } -> std::convertible_to<std::uint32_t>;
  typename C::InterruptOff;
  C::install(handler);
  { C::now_us() } -> std::same_as<std::uint64_t>;
  C::power_down();
  C::start();
  C::detach();
  { C::take_events() } -> std::same_as<Events>;
  { C::clean_up_after_reset() } -> std::same_as<bool>;
  { C::speed() } -> std::same_as<Speed>;
  C::set_address(address);
  C::open_endpoints(speed);
  C::close_endpoints();
  C::stall(pipe);
  C::unstall(pipe);
  C::stall_control();
  { C::take_setup(setup) } -> std::same_as<bool>;
  { C::setup_waits() } -> std::same_as<bool>;
  C::begin(pipe, bytes);
  C::cancel(pipe);
  { C::take_completed() } -> std::same_as<std::uint32_t>;
  { C::moved(pipe) } -> std::same_as<std::size_t>;
};

}  // namespace astro::usb_device
