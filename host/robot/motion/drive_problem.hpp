#pragma once

namespace astro::robot {

/// A path or speed that is not possible. Values: the quantity with its unit, and the number.
enum class PathProblem { impossible_number };

/// Why a program may not drive a robot, why its drive ended, or why it gets a notice. Values: for segment_aborted the
/// segment, for ended_early what was done to the robot ("stopped"), for faults_left_behind the faults that were cleared;
/// then the process id and the command line of the other program, if they are known.
enum class DriveProblem {
  stopped_by_another,
  armed_for_another,
  driven_by_another,
  segment_aborted,
  ended_early,
  stop_unconfirmed,
  faults_left_behind
};

}  // namespace astro::robot
