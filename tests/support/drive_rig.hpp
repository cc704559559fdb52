#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "firmware/app/drive.hpp"
#include "hal/sim/board.hpp"
#include "tests/support/desk.hpp"

/// The control tick on the simulated robot without a link: for claims about motion that look at every
/// millisecond.
namespace astro::support {

/// What the issue asks of control: data-sheet motors of which one is 10 % stronger, friction, thesis slip.
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
      : config_(config), board_(config), drive_(set) {
    run_ms(100);  // through boot
    drive_.arm();
  }

  /// One tick of a host that is alive, and of the world.
  void step() {
    drive_.host_seen();
    if (holds_velocity_) drive_.drive_velocity(velocity_);
    const Drive::Output output = drive_.advance({.now_us = board_.clock().now_us(),
                                                 .counts = board_.encoders().read(),
                                                 .battery_mv = board_.battery().millivolts(),
                                                 .driver_fault = board_.motors().fault()});
    switch (output.bridge) {
      case Drive::Output::Bridge::drive:
        board_.motors().drive(output.duty);
        break;
      case Drive::Output::Bridge::brake:
        board_.motors().brake();
        break;
      case Drive::Output::Bridge::coast:
        board_.motors().coast();
        break;
    }
    board_.advance_tick();
  }
  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) step();
  }

  /// A host that repeats this velocity from now on.
  void hold_velocity(double v_mps, double omega_radps) {
    velocity_ = {micro(v_mps), micro(omega_radps)};
    holds_velocity_ = true;
  }
  void release() { holds_velocity_ = false; }

  /// False if it does not fit.
  bool add(const Segment& segment, int tag = 1) {
    Trapezoid profile;
    return Trapezoid::plan(segment, make_limits(ParameterSet{}), profile) &&
           drive_.add_segment(profile, static_cast<std::uint16_t>(tag));
  }

  Drive& drive() { return drive_; }
  sim::Board& board() { return board_; }

  // The truth.
  double left_mps() const { return wheel_mps(sim::Side::left); }
  double right_mps() const { return wheel_mps(sim::Side::right); }
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
  double wheel_mps(sim::Side side) const {
    return board_.drivetrain().speed_radps()[sim::at(side)] *
           sim::true_geometry(config_).diameter_m[sim::at(side)] / 2;
  }

  sim::Config config_;
  sim::Board board_;
  Drive drive_;
  BodyTwist velocity_;
  bool holds_velocity_ = false;
};

}  // namespace astro::support
