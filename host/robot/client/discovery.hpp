#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/protocol/session.hpp"
#include "host/base/error.hpp"
#include "host/robot/port/open_transport.hpp"
#include "host/robot/port/ports.hpp"
#include "host/robot/sharing/shared_port.hpp"

namespace astro::robot {

struct FoundPort {
  Port port;
  std::optional<protocol::HelloReply> robot;
  Remark reason;  // why there is no robot
};

/// Sends Hello to all ports at the same time; takes at most about `timeout` in all. The answers are in the
/// order of the ports. A port that another program shares is asked through that program; one that it does not
/// share is not opened, and its reason says so.
std::vector<FoundPort> find_robots(SharedPorts& shared, const std::vector<Port>& ports, microseconds timeout,
                                   unsigned baud = kDefaultBaud);

}  // namespace astro::robot
