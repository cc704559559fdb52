#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "firmware/app/tick/drive.hpp"
#include "hal/sim/board.hpp"
#include "tests/support/robots/desk.hpp"

/// The control tick on the simulated robot, without a link, for tests of motion in every millisecond.
namespace astro::support {

/// The robot of the control tests: data-sheet motors, one of them 10 % stronger, friction, the slip of the
/// thesis.
inline sim::Config mismatched_robot() {
  sim::Config config;
  config.motor_mismatch = 0.1;
  config.slip_m = kThesisSlip_m;
  return config;
}

struct OdometryPose {
  double x_m, y_m, theta_rad;
};

class DriveRig {
 public:
  explicit DriveRig(const sim::Config& config = mismatched_robot(), const ParameterSet& set = {})
      : config_(config), set_(set), board_(config), drive_(set) {
    run_ms(100);  // through boot
    drive_.arm();
  }

  /// One tick of the firmware and of the world; the host is alive.
  void step() {
    if (!silent) drive_.host_seen();
    if (!silent && hold_ == Hold::velocity) drive_.drive_velocity(velocity_);
    if (!silent && hold_ == Hold::voltages) drive_.drive_wheels(voltages_);
    const Drive::Output output = drive_.advance({.now_us = board_.clock().now_us(),
                                                 .counts = counts(),
                                                 .battery_mv = board_.battery().millivolts(),
                                                 .driver_fault = board_.motors().fault(),
                                                 .on_time = late_ticks-- <= 0});
    apply(output, board_.motors());
    drive_.plan();
    board_.advance_tick();
  }
  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) step();
  }

  /// From now on the host repeats this velocity.
  void hold_velocity(double v_mps, double omega_radps) {
    velocity_ = {micro(v_mps), micro(omega_radps)};
    hold_ = Hold::velocity;
  }
  void hold_voltages(const WheelVoltages& voltages) {
    voltages_ = voltages;
    hold_ = Hold::voltages;
  }
  void release() { hold_ = Hold::nothing; }

  // Faults.
  bool silent = false;  // true: the host is silent from now on
  int late_ticks = 0;   // so many of the next ticks are not on time
  void reverse_left_encoder() {
    turned_at_ = board_.encoders().read().left;
    reversed_ = true;
  }
  /// The firmware starts again on the same board.
  void restart() {
    drive_ = Drive(set_);
    release();
    step();
  }
  /// Repairs everything that a test can break.
  void repair() {
    silent = false;
    board_.motors().set_fault(false);
    board_.battery().set_open_circuit_V(config_.supply_V);
    for (const Side side : {Side::left, Side::right}) board_.set_load(side, {});
  }
  bool powered() { return board_.motors().state() == sim::Bridge::drive; }

  /// False if it does not fit.
  bool add(const Segment& segment, int tag = 1) {
    return drive_.add_segment(segment, static_cast<std::uint16_t>(tag));
  }

  Drive& drive() { return drive_; }
  sim::Board& board() { return board_; }

  // Ground truth.
  double left_mps() const { return wheel_mps(Side::left); }
  double right_mps() const { return wheel_mps(Side::right); }
  double v_mps() const { return (left_mps() + right_mps()) / 2; }
  double omega_radps() const { return (right_mps() - left_mps()) / config_.true_wheelbase_m; }

  OdometryPose odometry() const {
    const Pose& pose = drive_.pose();
    constexpr double kTurn_rad = 2 * std::numbers::pi;
    return {std::ldexp(static_cast<double>(pose.x), -Pose::kPositionBits),
            std::ldexp(static_cast<double>(pose.y), -Pose::kPositionBits),
            kTurn_rad * (pose.turns + std::ldexp(static_cast<double>(pose.theta.raw()), -64))};
  }

 private:
  static std::int32_t micro(double value) { return static_cast<std::int32_t>(std::lround(value * 1e6)); }
  double wheel_mps(Side side) const {
    return board_.drivetrain().speed_radps()[at(side)] * sim::true_geometry(config_).diameter_m[at(side)] / 2;
  }

  enum class Hold { nothing, velocity, voltages };

  hal::EncoderCounts counts() {
    hal::EncoderCounts now = board_.encoders().read();
    if (reversed_) now.left = 2 * turned_at_ - now.left;
    return now;
  }

  sim::Config config_;
  ParameterSet set_;
  sim::Board board_;
  Drive drive_;
  BodyTwist velocity_;
  WheelVoltages voltages_;
  Hold hold_ = Hold::nothing;
  std::int32_t turned_at_ = 0;
  bool reversed_ = false;
};

}  // namespace astro::support
