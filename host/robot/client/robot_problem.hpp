#pragma once

namespace astro::robot {

/// Why a robot does not do what it is asked. Values: for `faulted` the faults, then the process id and the
/// command line of the program that caused an emergency stop, if they are known; for `refused` the request,
/// or a parameter and its value.
enum class RobotProblem { faulted, refused };

}  // namespace astro::robot
