#pragma once

#include <string>

#include "host/robot/arbitration/relay_messages.hpp"
#include "host/robot/client/client.hpp"

/// Who else uses the robot's port, for sentences about what another program did to a drive.
namespace astro::robot {

/// The programs at this port; nobody if it is not shared.
PortUsers port_users(Client& client);

/// "another program (astrolabe drive, process 123)"; without the part in brackets if it is not known.
std::string another_program(std::uint32_t pid, const CommandLine& command);

}  // namespace astro::robot
