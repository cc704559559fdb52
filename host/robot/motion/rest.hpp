#pragma once

#include "host/robot/client/client.hpp"

namespace astro::robot {

/// Waits for a robot that was told to stop, for as long as its own motion limits let a ramp take and at least
/// five seconds. A robot that still drives then is disarmed, which opens its bridges at once: it may roll on.
///
/// Returns false if it had to be disarmed.
/// Errors  all that Client::request throws.
[[nodiscard]] bool wait_for_rest(Client& client);

/// Waits for wheels that nothing drives any more: a robot whose bridges a fault has opened rolls on until it
/// has used up its speed. False if they still turn after two seconds. Ends this client's telemetry.
/// Errors  all that Client::request throws; LinkLost if no telemetry comes.
[[nodiscard]] bool wait_until_wheels_stand(Client& client);

}  // namespace astro::robot
