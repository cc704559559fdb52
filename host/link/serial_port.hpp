#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace astro::link {

/// Opens and locks a serial port or pty for open_transport(), which says what it throws. Returns a
/// non-blocking file descriptor that the caller owns. The lock is flock's: it ends with the process, however
/// that ends.
int open_serial_port(const std::string& path, unsigned baud);

/// Name of a process whose controlling terminal this device is. A pty's number is given away again once its
/// simulator has gone: without this look a dead simulator's link can lead into somebody's shell.
std::optional<std::string> terminal_user(dev_t device);

}  // namespace astro::link
