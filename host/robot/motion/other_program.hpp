#pragma once

#include <string>

#include "host/robot/client/client.hpp"
#include "host/robot/sharing/relay_messages.hpp"

/// Other programs that use the robot's port: who they are, for sentences about what one of them did to a drive, and the drive that one
/// left behind.
namespace astro::robot {

/// The programs at this port; nobody if it is not shared.
PortUsers port_users(Client& client);

/// "another program (astrolabe drive, process 123)"; without the part in brackets if it is not known.
std::string another_program(std::uint32_t pid, const CommandLine& command);

/// Stops a robot that drives although nobody is known to drive it, as after a program that was killed. Left alone are
///   - a robot that another program at this port drives,
///   - one whose command time-out is at most a second (`command_timeout`; 0 is none): it stops by itself if its host has gone, and
///     if it drives on, its host is alive at its other port.
/// A robot without such a time-out cannot be told from one that its host at the other port drives, and is stopped.
///
/// Returns whether it was stopped. Errors: all that Client::request throws.
bool stop_left_drive(Client& client, microseconds command_timeout);

}  // namespace astro::robot
