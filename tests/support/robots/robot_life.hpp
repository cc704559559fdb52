#pragma once

#include <cstdint>
#include <string>

/// A random life of one simulated robot, to find power that nobody has commanded. The robot has random wiring
/// and loads and a random legal parameter set, and gets requests at two ports from hosts that may fall silent
/// at any moment.
///
/// The same seed gives the same life.
namespace astro::support {

struct LifeReport {
  std::string violation;  // empty if nothing was violated
  std::uint64_t ticks = 0;
  std::uint64_t powered_ticks = 0;
  int silences = 0;  // of three seconds
  int silences_that_began_with_power = 0;
  int refused_after_halt = 0;     // motion requests
  std::uint32_t faults_seen = 0;  // mask
};

/// What must hold after every millisecond:
///   - the motors have power only while the robot is armed, and it arms only if a host asks it to
///   - a motion request is taken only from the host that armed the robot last, and not after a stop of anybody; a robot
///     that was stopped or paused drives again only after an Arm or, if it was paused, a Resume that is not of a driver
///     whom somebody else has paused
///   - three seconds after the last byte from any host the bridges are open. If command_timeout is longer
///   than
///     200 ms the robot may drive for that much longer; if it is 0 the robot may go on driving. Neither
///     exception applies to a robot that was told to stop.
LifeReport live(std::uint64_t seed);

}  // namespace astro::support
