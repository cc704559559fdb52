#pragma once

#include <memory>
#include <string>

#include "host/base/descriptor.hpp"
#include "host/robot/port/transport.hpp"

namespace astro::robot {

/// What is wrong with a port. Values: its address, unless none is named.
enum class PortProblem {
  none_named,
  absent,
  is_folder,
  not_serial,
  is_terminal,
  no_permission,
  in_use,
  no_address,
  not_local,
  nobody_listens
};

inline constexpr unsigned kDefaultBaud = 1'000'000;

/// Opens the connection to a robot.
///
///   a path          a serial port or a pty, or a symlink to one: raw mode, 8N1, any baud, locked against
///                   other programs for as long as it is open
///   tcp:HOST:PORT   only on this machine: localhost or a loopback address ("tcp:[::1]:5555")
///
/// For this program alone; shared_port.hpp shares the port with other programs.
///
/// Throws Error: no such port (and which ones exist), no permission, in use, a terminal that somebody works
/// at, not a serial port, not on this machine, nobody listens, not an address.
std::unique_ptr<Transport> open_transport(const std::string& address, unsigned baud = kDefaultBaud);

/// Opens the same as a non-blocking file descriptor. A TCP address is not locked.
Descriptor open_line(const std::string& address, unsigned baud);

/// The key of a TCP address, as PortInUse::key() is for a serial port. Throws Error if the address is not
/// one.
std::string tcp_key(const std::string& address);

}  // namespace astro::robot
