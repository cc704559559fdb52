#pragma once

#include <span>
#include <vector>

#include "host/calibration/gyro/gyro_calibration.hpp"
#include "host/calibration/gyro/gyro_drive.hpp"

namespace astro::calibration {

/// How a gyro follows the wheels of a drive.
struct GyroFollowing {
  double product = 1;  // GyroAgainstWheels
  double lag_s = 0, doubt_s = 0.002;
  double drift_radps =
      0;  // that the wheels' heading goes on beyond the gyro's while the robot rests: the bias
  double by_way_radpm = 0;  // that the wheels' heading goes on beyond the true one on each metre
  TurnNoise noise;
};

/// Turns that no wheel saw, by the rule that the robot itself follows while it drives (common/kinematics/slip_watch.hpp): over 0.15 s
/// and over 0.3 s, gyro and wheels differ by more than 5.5 standard deviations and by 0.6 degrees at least. Where a drive's usual
/// differences are larger than they should be, as with a gyro that smooths its rates, the limit grows with them. What the robot
/// itself reported does not count: with a wheelbase that is 2 % off it takes each turn for a slip.
std::vector<UnseenTurn> unseen_turns(std::span<const WheelTurn> wheels, const GyroPath& gyro,
                                     const GyroFollowing& following);

}  // namespace astro::calibration
