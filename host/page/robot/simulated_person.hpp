#pragma once

#include <array>
#include <memory>

#include "host/robot/client/client.hpp"
#include "host/simulation/robot/virtual_robot.hpp"

namespace astro::page {

/// Whoever stands beside a simulated robot: sees how far its wheels turn, whatever its encoders say, and rolls it by hand. Looks
/// each time that telemetry comes.
class SimulatedPerson {
 public:
  SimulatedPerson(robot::Client& client, std::shared_ptr<simulation::VirtualRobot> robot);

  /// Turns since construction, forward positive; left, right.
  const std::array<double, 2>& turns() const { return turns_; }
  /// Rolls the robot straight on until its wheels have turned so often, and waits until they stand. Throws astro::Error if they do
  /// not turn, because the robot is driven or something holds it.
  void roll(double turns);

 private:
  void look();
  void push(double torque_Nm);
  void wait(microseconds time);

  robot::Client& client_;
  std::shared_ptr<simulation::VirtualRobot> robot_;
  std::uint64_t looked_us_;
  std::array<double, 2> turns_{};
  robot::Subscription on_telemetry_;
};

}  // namespace astro::page
