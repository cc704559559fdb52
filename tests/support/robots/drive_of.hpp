#pragma once

#include "host/simulation/robot/virtual_robot.hpp"

namespace astro::support {

/// The drive of a simulated robot. Its owner calls the tick, so nothing interrupts whoever looks at it, and
/// the reference may be kept after the hold.
inline const Drive& drive_of(simulation::VirtualRobot& robot) {
  const auto hold = robot.board().hold_tick();
  return robot.robot().drive(hold);
}

}  // namespace astro::support
