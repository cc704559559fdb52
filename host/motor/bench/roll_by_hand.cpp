#include "host/motor/bench/roll_by_hand.hpp"

#include <algorithm>
#include <cstdlib>

#include "host/base/error.hpp"

namespace astro::motor {
namespace {

constexpr double kStill_s = 2, kLongestWait_s = 60, kLeastTurn = 0.05;

/// Turns of the wheel that turned more.
double turned(const Moment& now, const Moment& start, const RobotFacts& robot) {
  const auto left = std::llabs(now.counts[0] - start.counts[0]);
  const auto right = std::llabs(now.counts[1] - start.counts[1]);
  return static_cast<double>(std::max(left, right)) / robot.counts_per_turn();
}

}  // namespace

void wait_for_roll(Bench& bench, const Moment& start, const std::function<void()>& idle) {
  Moment last = bench.fresh();
  double still_since_s = last.time_s;
  while (true) {
    idle();
    const Moment& now = bench.fresh();
    if (now.counts != last.counts) still_since_s = now.time_s;
    last = now;
    const bool moved = turned(now, start, bench.facts()) > kLeastTurn;
    if (moved && now.time_s - still_since_s >= kStill_s) return;
    if (!moved && now.time_s - start.time_s > kLongestWait_s)
      throw Error("nobody rolled the robot for a minute: nothing was changed");
  }
}

Roll roll_since(Bench& bench, const Moment& start, const RolledLength& length) {
  const RobotFacts& robot = bench.facts();
  Roll roll{
      {},          robot.counts_per_motor_rev, robot.gear_ratio, robot.wheel_diameter_m, length.distance_m,
      length.turns};
  const Moment& end = bench.fresh();
  for (const Side side : kSides)
    roll.counts[at(side)] = static_cast<double>(end.counts[at(side)] - start.counts[at(side)]);
  return roll;
}

}  // namespace astro::motor
