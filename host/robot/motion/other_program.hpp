#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/client/refusal.hpp"
#include "host/robot/sharing/relay_messages.hpp"

/// Other programs that use the robot's port. Names them for error messages, and stops a robot that one of them left driving.
namespace astro::robot {

/// The programs at this port; nobody if it is not shared.
PortUsers port_users(Client& client);

/// "another program (astrolabe drive, process 123)"; without the part in brackets if it is not known.
std::string another_program(std::uint32_t pid, const CommandLine& command);

/// That another program drives the robot, or has stopped it, with the program if it is known.
Remark driven_by_another(const PortUsers& users);
Remark stopped_by_another(const PortUsers& users);

/// Appends the process id and the command line of another program to a remark's values, if it is known.
std::vector<std::string> with_program(std::vector<std::string> values, std::uint32_t pid,
                                      const CommandLine& command);

/// Why the robot refused a request: another program, if one is known that explains it.
Remark why_refused(Client& client, const RobotRefused& refused);

/// Stops a robot that drives although no driver is known, for example after its program was killed. Does not stop
///   - a robot that another program at this port drives,
///   - a robot whose command time-out is at most one second (`command_timeout`; 0: none). It stops by itself if its host has
///     gone; if it drives on, its host is alive at its other port.
/// A robot without such a time-out is stopped even if a host at its other port drives it, because that cannot be detected.
///
/// Returns whether it was stopped. Errors: all that Client::request throws.
bool stop_left_drive(Client& client, microseconds command_timeout);

}  // namespace astro::robot
