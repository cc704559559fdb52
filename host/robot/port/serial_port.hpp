#pragma once

#include <sys/stat.h>

#include <optional>
#include <string>
#include <utility>

#include "host/base/descriptor.hpp"
#include "host/base/error.hpp"
#include "host/robot/port/open_transport.hpp"

namespace astro::robot {

/// Another program has locked the port.
class PortInUse : public Error {
 public:
  PortInUse(const std::string& sentence, const std::string& address, std::string key)
      : Error(sentence + ": end that program first", PortProblem::in_use, {address}), key_(std::move(key)) {}
  /// The same in all programs, whichever name of the port they use.
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

/// The same for one device in all programs, whichever path they use: "port-188-0".
std::string port_key(const struct stat& about);
std::string port_key_of(int descriptor);

/// Opens and locks a serial port or pty for open_transport(). Throws as that does, and PortInUse if another
/// program has locked the port. Returns a non-blocking file descriptor. The lock is flock's: it ends with the
/// process, however that ends.
Descriptor open_serial_port(const std::string& path, unsigned baud);

}  // namespace astro::robot
