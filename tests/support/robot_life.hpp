#pragma once

#include <cstdint>
#include <string>

/// A random life of one simulated robot, made to find power that nobody asked for: a robot that is wired and
/// loaded in some way, carries some legal set of parameters, and is told things at two ports by hosts that
/// fall silent at any moment.
///
/// The same seed gives the same life.
namespace astro::support {

struct LifeReport {
  std::string violation;  // empty: everything held
  std::uint64_t ticks = 0;
  std::uint64_t powered_ticks = 0;
  int silences = 0;  // of three seconds
  int silences_that_began_with_power = 0;
  std::uint32_t faults_seen = 0;  // mask
};

/// What must hold after every millisecond:
///   - the motors have power only while the robot is armed, and it arms only if a host asks it to
///   - three seconds after the last byte from any host the bridges are open. Where command_timeout is longer
///   than
///     200 ms the robot may drive for that much longer; where it is 0 it may drive on, as its owner has
///     decided. A robot that was told to stop is exempt in neither case.
LifeReport live(std::uint64_t seed);

}  // namespace astro::support
