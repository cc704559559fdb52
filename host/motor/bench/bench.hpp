#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/motor/bench/robot_facts.hpp"
#include "host/robot/motion/drive.hpp"

namespace astro::motor {

/// One telemetry sample; left, right.
struct Moment {
  double time_s = 0;  // robot's clock, from the bench's first sample
  std::array<std::int64_t, 2> counts{};
  std::array<double, 2> position_m{}, voltage_V{}, observed_mps{}, set_point_mps{};
  double supply_V = 0;
};

/// Drives a robot's wheels and records them: keeps every telemetry sample of its lifetime, and sends voltages
/// and velocities in steps of 20 ms on the robot's clock, well within the robot's command time-out.
///
/// Errors  as DriveSession; LinkLost if the robot sends no telemetry.
class Bench {
 public:
  /// Requests telemetry at the highest rate that the link transmits without loss: every 1, 2, 5 or 10 ms.
  Bench(robot::Client& client, const RobotFacts& facts);
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// One step of 20 ms.
  void apply(robot::DriveSession& session, double left_V, double right_V);
  void velocity(robot::DriveSession& session, double v_mps);

  /// Repeats the step until `seconds` have passed on the robot's clock.
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
