#pragma once

#include <cstddef>
#include <vector>

#include "host/wall/wall_estimate.hpp"

/// Which moves in front of a wall make the factors as precise as wanted, computed before anything is driven.
namespace astro::wall {

/// Each move begins and ends flush with the wall.
///   repeat  a little way off and back: shows how well the robot squares itself
///   gap     straight off, where somebody reads the gap, and back: the scale
///   laps    off far enough to turn; then again and again half a turn, a line forwards away from the wall, half a turn, a line forwards
///           back; and back to the wall: E_d, and b
///   spin    off far enough to turn, some whole turns on the spot, and back: b
/// A robot that backs off and comes forward again undoes what its unequal wheels have turned it by, so only the laps show E_d.
struct WallMove {
  enum class Kind { repeat, gap, laps, spin };
  Kind kind = Kind::laps;
  double away_m = 0;  // how far the robot backs off
  int turns = 0;      // whole turns of a spin, laps of laps; counter-clockwise positive
  double line_m = 0;  // of laps
  bool operator==(const WallMove&) const = default;
};

/// Wanted standard errors, of E_d and of b / S (relative). That of S is what the readings of the ruler leave.
struct WallTargets {
  double E_d = 2e-4, b = 1e-3;
};

struct WallWishes {
  WallTargets targets;
  double line_m = 3;       // of laps
  double turning_m = 0.4;  // gap in which the robot can turn
  int readings = 2;        // of the gap
  double gap_m = 2;        // which is read
  double speed_mps = 0.7, yaw_rate_radps = 1.8;
  double acceleration_mps2 = 0.5, yaw_acceleration_radps2 = 3;
  WallNoise noise;
};

struct WallCourse {
  std::vector<WallMove> moves;
  WallErrors expected;  // of a nominal robot
  double time_s = 0;    // with four seconds for each squaring
};

/// Three repetitions and one short lap each way round, so that a robot that nobody has calibrated yet does not stray; the gaps that are read; and laps,
/// two at a time, one way round and then the other, until E_d is known; turns on the spot if b is not known by then. Of both as many as the targets need by
/// the estimator's own covariance, but at most kMostMoves: `expected` then says what is reached.
inline constexpr int kMostMoves = 200;
inline constexpr std::size_t kFirstMoves = 5;  // before the gaps
WallCourse plan_course(const WallWishes& wishes, const calibration::WheelFactors& loaded);

/// The move of laps number `index` from 0 of a course: every other one is clockwise.
WallMove laps_number(int index, const WallWishes& wishes);
WallMove spin_number(int index, const WallWishes& wishes);

/// The standard errors that a nominal robot has after these moves.
WallErrors expected_errors(const std::vector<WallMove>& moves, const calibration::WheelFactors& loaded,
                           const WallNoise& noise);

double time_of(const WallMove& move, const WallWishes& wishes);

}  // namespace astro::wall
