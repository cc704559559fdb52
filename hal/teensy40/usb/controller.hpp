#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/teensy40/usb/descriptors.hpp"
#include "hal/teensy40/usb/setup.hpp"
#include "hal/teensy40/usb/transfers.hpp"

/// The USB device controller at register level: one transfer under way for each pipe.
namespace astro::teensy40::usb_device::controller {

/// Pipes of endpoints 0 to 4.
inline constexpr std::size_t kHeads = 10;

/// Clocks, transceiver and controller; attaches to the bus.
void start();
/// Leaves the bus.
void detach();
/// Leaves the bus in any state of the controller: the program before may have left it attached.
void power_down();

/// Returns the pending events and clears them.
struct Events {
  bool reset;      // the bus is in reset
  bool suspended;  // or the cable is out
  bool resumed;
  bool transfers;
};
Events take_events();

/// Call it on a bus reset: drops all transfers. False if the reset is already over, which is too late.
bool clean_up_after_reset();
Speed speed();
/// The controller uses this address after the next packet to the host, so call it before that packet.
void set_address(std::uint8_t address);
/// Sets up the robot's three endpoints for this speed, or removes them. Drops their transfers.
void open_endpoints(Speed speed);
void close_endpoints();
void stall(Pipe pipe);
void unstall(Pipe pipe);
void stall_control();

/// True if a SETUP packet has arrived; transfers at endpoint 0 are then dropped.
bool take_setup(Setup& setup);

/// A SETUP packet waits; no transfer may be started at endpoint 0 before it has been taken.
bool setup_waits();

/// Starts a transfer. The bytes must stay in place until it is over. If the bulk endpoint sends a multiple of
/// full packets to the host, an empty packet follows, because the host would otherwise wait for more.
void begin(Pipe pipe, std::span<std::uint8_t> bytes);
/// Drops the transfer of a pipe, even if it has just ended.
void cancel(Pipe pipe);
/// Pipes whose transfers have ended since the last call, a bit each.
std::uint32_t take_completed();
/// Bytes moved by the last transfer of a pipe.
std::size_t moved(Pipe pipe);

}  // namespace astro::teensy40::usb_device::controller
