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
/// The same whatever state the controller is in: what ran before this program may have left it attached.
void power_down();

/// Events that wait, which this takes.
struct Events {
  bool reset;      // the bus is in reset
  bool suspended;  // or the cable is out
  bool resumed;
  bool transfers;
};
Events take_events();

/// After a bus reset: everything under way is dropped. False if the reset is over already, which is too late.
bool clean_up_after_reset();
Speed speed();
/// The controller answers to this address once the next packet to the host has been taken: to be called
/// before.
void set_address(std::uint8_t address);
/// The robot's three endpoints, with the packets of this speed; or none of them. Drops what is under way.
void open_endpoints(Speed speed);
void close_endpoints();
void stall(Pipe pipe);
void unstall(Pipe pipe);
void stall_control();

/// True if a SETUP packet has come; what was under way at endpoint 0 is dropped then.
bool take_setup(Setup& setup);

/// A SETUP packet waits, and nothing may be started at endpoint 0 before it has been taken.
bool setup_waits();

/// Starts a transfer. The bytes stay where they are until it is over. To the host, a multiple of full packets
/// of the bulk endpoint is followed by an empty one, without which the host would wait for more.
void begin(Pipe pipe, std::span<std::uint8_t> bytes);
/// Drops what is under way at a pipe, also that it has just ended.
void cancel(Pipe pipe);
/// Pipes whose transfers have ended since the last call, a bit each.
std::uint32_t take_completed();
/// Bytes moved by the last transfer of a pipe.
std::size_t moved(Pipe pipe);

}  // namespace astro::teensy40::usb_device::controller
