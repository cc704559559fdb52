#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/robot/motion/drive.hpp"
#include "host/motor/bench/robot_facts.hpp"

namespace astro::motor {

/// One telemetry sample; left, right.
struct Moment {
  double time_s = 0;  // robot's clock, from the bench's first sample
  std::array<std::int64_t, 2> counts{};
  std::array<double, 2> position_m{}, voltage_V{}, observed_mps{}, set_point_mps{};
  double supply_V = 0;
};

/// A robot whose wheels are moved and watched: keeps every telemetry sample for as long as it lives, and
/// gives voltages and velocities in steps of 20 ms on the robot's clock, well within its command time-out.
///
/// Errors  as DriveSession; LinkLost if the robot sends no telemetry.
class Bench {
 public:
  /// Asks for telemetry as often as the link carries it whole: 1, 2, 5 or 10 ms.
  Bench(robot::Client& client, const RobotFacts& facts);
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// One step.
  void apply(robot::DriveSession& session, double left_V, double right_V);
  void velocity(robot::DriveSession& session, double v_mps);

  /// The same until this much time has passed on the robot's clock.
  void hold(robot::DriveSession& session, double left_V, double right_V, double seconds);

  const RobotFacts& facts() const { return facts_; }
  double period_s() const { return period_s_; }
  const std::vector<Moment>& moments() const { return moments_; }
  const Moment& now() const { return moments_.back(); }

  /// Waits for a sample that the robot took after this call.
  const Moment& fresh();

 private:
  void choose_period();
  void note(const protocol::Telemetry& telemetry);
  void wait_step();

  robot::Client& client_;
  RobotFacts facts_;
  std::vector<Moment> moments_;
  std::uint64_t first_us_ = 0, newest_us_ = 0;
  std::array<std::int32_t, 2> seen_{};
  double period_s_ = 0;
  robot::Subscription subscription_;
};

}  // namespace astro::motor
