#pragma once

#include "host/robot/client/client.hpp"

namespace astro::robot {

/// Stops a robot that drives although nobody is known to drive it, as after a program that was killed. Left alone are
///   - a robot that another program at this port drives,
///   - one whose command time-out is at most a second (`command_timeout`; 0 is none): it stops by itself if its host has gone, and
///     if it drives on, its host is alive at its other port.
/// A robot without such a time-out cannot be told from one that its host at the other port drives, and is stopped.
///
/// Returns whether it was stopped. Errors: all that Client::request throws.
bool stop_left_drive(Client& client, microseconds command_timeout);

}  // namespace astro::robot
