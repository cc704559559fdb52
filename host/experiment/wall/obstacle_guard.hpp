#pragma once

#include <array>

#include "host/experiment/wall/wall_robot.hpp"
#include "host/experiment/wall/wheel_watch.hpp"

namespace astro::experiment {

/// Notices that a robot which follows its set points pushes against something. For 40 ms a wheel
///   has more voltage than its feed-forward says for its set point and the steepest acceleration, by what the push limit allows; or
///   falls 0.12 m/s behind its set point, which shows more at high speed, where the voltage is near its end.
/// It bounds how long the robot pushes, not how hard: the control loop raises the voltage as it likes. Without it the robot would find
/// a stall at half of its voltage after 300 ms.
class ObstacleGuard {
 public:
  ObstacleGuard(const WallRobot& robot, double push_V) : robot_(robot), push_V_(push_V) {}

  void look(const WheelMoment& moment);
  bool pushes() const { return pushes_; }

 private:
  static constexpr int kSamples = 4;  // of 10 ms

  bool is_held(const WheelMoment& moment, std::size_t side) const;
  double excess_V(const WheelMoment& moment, std::size_t side) const;

  const WallRobot& robot_;
  double push_V_;
  std::array<int, 2> in_a_row_{};
  bool pushes_ = false;
};

}  // namespace astro::experiment
