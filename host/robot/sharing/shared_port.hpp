#pragma once

#include <functional>
#include <memory>
#include <string>

#include "host/robot/port/open_transport.hpp"

namespace astro::robot {

/// Opens the way to a robot as open_transport() does, and shares it with the other programs of this user: the
/// first one holds the port and serves the others, who work as if they had opened it. What the programs may
/// do beside each other is in relay.hpp. If the first one ends, it leaves a process behind for those that
/// still use the port; if it is killed, each of them gets LinkLost, and the first that opens the port again
/// holds it. A program that holds the port and has stopped is named in the sentence of the Error.
///
/// Throws Error as open_transport() does; a port is in use only where its holder does not share it.
///
/// `notice` gets a sentence where this program holds the port and can let nobody in.
using Notice = std::function<void(const std::string&)>;
std::unique_ptr<Transport> open_shared_port(
    const std::string& address, unsigned baud = kDefaultBaud, Notice notice = [](const std::string&) {});

}  // namespace astro::robot
