#pragma once

#include <functional>
#include <memory>
#include <string>

#include "host/base/error.hpp"
#include "host/robot/port/open_transport.hpp"

namespace astro::robot {

/// Opens the connection to a robot as open_transport() does, and shares it with the other programs of this
/// user: the first one holds the port and serves the others, which work as if they had opened it. relay.hpp
/// says what the programs may do beside each other. If the first one ends, it leaves a process behind for
/// those that still use the port; if it is killed, each of them gets LinkLost, and the first that opens the
/// port again holds it. If the program that holds the port hangs, the Error names it.
///
/// Throws Error as open_transport() does; a port counts as in use only if its holder does not share it.
///
/// `notice` gets a sentence if this program holds the port and other programs cannot connect.
using Notice = std::function<void(const Remark&)>;
std::unique_ptr<Transport> open_shared_port(
    const std::string& address, unsigned baud = kDefaultBaud, Notice notice = [](const Remark&) {});

}  // namespace astro::robot
