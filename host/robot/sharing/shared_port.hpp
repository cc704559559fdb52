#pragma once

#include <functional>
#include <memory>
#include <string>

#include "host/base/error.hpp"
#include "host/robot/port/open_transport.hpp"

namespace astro::robot {

/// `notice` gets a sentence if this program holds the port and other programs cannot connect.
using Notice = std::function<void(const Remark&)>;

class ClosedPorts;  // in shared_port.cpp

/// The ports of one program, each shared with the other programs of this user: the first one holds the port and
/// serves the others, which work as if they had opened it. relay.hpp says what the programs may do beside each
/// other.
///
/// End      A port that the program closes is served for as long as others use it: by this program until it
///          ends, then by the process that leave_to_others() leaves behind. Without that call, or if the program
///          is killed, each of them gets LinkLost, and the first that opens the port again holds it.
/// Threads  any.
class SharedPorts {
 public:
  SharedPorts();

  /// Opens the connection to a robot as open_transport() does. Throws Error as that does; a port counts as in use
  /// only if its holder does not share it. If the program that holds it hangs, the Error names it.
  std::unique_ptr<Transport> open(
      const std::string& address, unsigned baud = kDefaultBaud, Notice notice = [](const Remark&) {});

  /// Must be the last call of the program, however its work ended. Precondition: its transports are closed and its threads
  /// have ended.
  void leave_to_others();

 private:
  std::shared_ptr<ClosedPorts> closed_;
};

}  // namespace astro::robot
