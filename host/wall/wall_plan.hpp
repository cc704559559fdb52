#pragma once

#include <cstddef>
#include <vector>

#include "host/wall/wall_estimate.hpp"

/// Plans the moves in front of a wall that make the factors as precise as wanted, before anything is driven.
namespace astro::wall {

/// Each move begins and ends flush with the wall.
///   repeat  backs off a little and returns; shows how well the robot squares itself
///   gap     backs straight off, waits until somebody has read the gap, and returns; gives the scale
///   laps    backs off far enough to turn; then in each lap makes half a turn, drives a line away from the wall, makes half a
///           turn, and drives a line back, all forwards; then returns to the wall; gives E_d and b
///   spin    backs off far enough to turn, makes whole turns on the spot, and returns; gives b
/// If a robot backs off and comes forward again, the rotation that its unequal wheels cause cancels, so only the laps show E_d.
struct WallMove {
  enum class Kind { repeat, gap, laps, spin };
  Kind kind = Kind::laps;
  double away_m = 0;  // how far the robot backs off
  int turns = 0;      // whole turns of a spin, laps of laps; counter-clockwise positive
  double line_m = 0;  // of laps
  bool operator==(const WallMove&) const = default;
};

/// Wanted standard errors, of E_d and of b / S (relative). That of S follows from the readings of the ruler.
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

/// plan_course: three repetitions and one short lap each way round, so that a robot that nobody has calibrated yet does not
/// stray; then the gaps that are read; then moves of two laps, alternately one way round and the other, until E_d is precise;
/// then spins if b is not precise by then. The estimator's own covariance says how many are needed. There are at most
/// kMostMoves of each kind; `expected` then says what is reached.
inline constexpr int kMostMoves = 200;
inline constexpr std::size_t kFirstMoves = 5;  // before the gaps
WallCourse plan_course(const WallWishes& wishes, const calibration::WheelFactors& loaded);

/// The laps number `index` of a course, counted from 0; every other one is clockwise.
WallMove laps_number(int index, const WallWishes& wishes);
/// With so many turns that the squarings at both ends are no larger an error of b than the slip, but 3 to 10.
WallMove spin_number(int index, const WallWishes& wishes, double b_m);

/// The standard errors that a nominal robot has after these moves.
WallErrors expected_errors(const std::vector<WallMove>& moves, const calibration::WheelFactors& loaded,
                           const WallNoise& noise);

double time_of(const WallMove& move, const WallWishes& wishes);

}  // namespace astro::wall
