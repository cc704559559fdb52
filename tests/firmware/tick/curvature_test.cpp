#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "firmware/app/tick/drive.hpp"
#include "hal/sim/board.hpp"
#include "tests/common/fixed/seeded.hpp"

// The simulated robot has tyres that turn a spin about b and a gentle arc about b (1 + e); odometry and commands take that
// into account by the parameter e.
namespace astro {
namespace {

constexpr double kE = 0.03, kTurn_rad = 2 * std::numbers::pi;

/// A robot that differs from its parameters in nothing but e, without slip.
class RobotOnTyres {
 public:
  RobotOnTyres(double true_e, double parameter_e) : board_(config(true_e)), drive_(parameters(parameter_e)) {
    for (int i = 0; i < 100; ++i) step();  // through boot
    drive_.arm();
  }

  void follow(const std::vector<Segment>& path) {
    for (const Segment& segment : path) {
      ASSERT_TRUE(drive_.add_segment(segment, 1));
      SegmentEvent event{};
      for (int ms = 0; event.kind != SegmentEvent::Kind::completed; ++ms) {
        ASSERT_LT(ms, 300'000) << "the segment does not end";
        step();
        while (!drive_.events().empty()) event = drive_.events().pop();
      }
    }
  }
  void hold_velocity(const BodyTwist& twist, int ms) {
    for (int i = 0; i < ms; ++i) {
      drive_.drive_velocity(twist);
      step();
    }
  }

  bool has(Fault fault) const { return (drive_.faults().mask() & bit(fault)) != 0; }
  const WheelSpeeds& set_points() const { return drive_.wheels().set_points(); }
  double true_heading_rad() const { return board_.truth().theta_rad; }
  double heading_rad() const {
    const Pose& pose = drive_.pose();
    return kTurn_rad * (pose.turns + std::ldexp(static_cast<double>(pose.theta.raw()), -64));
  }
  double heading_error_rad() const { return heading_rad() - true_heading_rad(); }
  double position_error_m() const {
    const Pose& pose = drive_.pose();
    const double metre = std::ldexp(1.0, Pose::kPositionBits);
    return std::hypot(static_cast<double>(pose.x) / metre - board_.truth().x_m,
                      static_cast<double>(pose.y) / metre - board_.truth().y_m);
  }

 private:
  static sim::Config config(double true_e) {
    sim::Config config;
    config.slip_m = 0;
    config.motor_mismatch = 0.1;
    config.true_e = true_e;
    return config;
  }
  static ParameterSet parameters(double e) {
    ParameterSet set;
    set.set(Param::e, static_cast<std::int32_t>(std::lround(std::ldexp(e, 30))));
    return set;
  }

  void step() {
    drive_.host_seen();
    const Drive::Output output = drive_.advance({.now_us = board_.clock().now_us(),
                                                 .counts = board_.encoders().read(),
                                                 .battery_mv = board_.battery().millivolts(),
                                                 .driver_fault = false,
                                                 .on_time = true});
    apply(output, board_.motors());
    drive_.plan();
    board_.advance_tick();
  }

  sim::Board board_;
  Drive drive_;
};

Segment line(double metres) { return {.length_nm = std::llround(1e9 * metres)}; }
Segment spin(double turns) { return {.angle_32 = std::llround(std::ldexp(turns, 32))}; }
Segment arc(double radius_m, double turns) {
  Segment segment = spin(turns);
  segment.length_nm = std::llround(1e9 * radius_m * kTurn_rad * std::abs(turns));
  return segment;
}

/// Twice round, in both senses: squares of lines and spins, with round corners, and circles of several sizes.
std::vector<Segment> squares() {
  std::vector<Segment> path;
  for (const double sense : {1.0, -1.0})
    for (int corner = 0; corner < 8; ++corner) {
      path.push_back(line(1));
      path.push_back(corner < 4 ? spin(sense / 4) : arc(0.3, sense / 4));
    }
  return path;
}
std::vector<Segment> circles() { return {arc(1, 2), arc(0.3, 2), arc(2, 1), arc(0.1, 3)}; }

struct Errors {
  double heading_rad, position_m;
};

Errors errors_after(const std::vector<Segment>& path, double true_e, double parameter_e) {
  RobotOnTyres robot(true_e, parameter_e);
  robot.follow(path);
  fmt::print("  true e {:.2f}, parameter e {:.2f}: heading off by {:.3f} mrad, position by {:.3f} mm\n",
             true_e, parameter_e, 1e3 * robot.heading_error_rad(), 1e3 * robot.position_error_m());
  return {std::abs(robot.heading_error_rad()), robot.position_error_m()};
}

// One count of a wheel is 0.28 mrad, and half a count of each may be under way. What is measured besides is the delay of the
// observed speeds when an arc begins or ends, about 0.1 mrad in all; each mrad moves what follows by up to 1 mm a metre.
constexpr double kHeading_rad = 0.4e-3, kPosition_m = 0.2e-3;

TEST(CurvatureEffect, InTheParameterOdometryFollowsSquaresAsWithoutOne) {
  const Errors without = errors_after(squares(), 0, 0), with = errors_after(squares(), kE, kE);
  for (const Errors& errors : {without, with}) {
    EXPECT_LT(errors.heading_rad, kHeading_rad);
    EXPECT_LT(errors.position_m, kPosition_m);
  }
  // The turns of both senses cancel, the way between them does not.
  EXPECT_GT(errors_after(squares(), kE, 0).position_m, 0.02);
}

TEST(CurvatureEffect, InTheParameterOdometryFollowsCirclesAsWithoutOne) {
  const Errors without = errors_after(circles(), 0, 0), with = errors_after(circles(), kE, kE);
  for (const Errors& errors : {without, with}) {
    EXPECT_LT(errors.heading_rad, kHeading_rad);
    EXPECT_LT(errors.position_m, kPosition_m);
  }
  // Two turns of 1 m alone: kappa is 0.29, so that g is 0.29, and 0.03 g of 12.6 rad is 110 mrad.
  EXPECT_GT(errors_after(circles(), kE, 0).heading_rad, 0.1);
}

/// The true yaw rate over ten seconds of a velocity, after two seconds of getting there.
double true_yaw_rate_radps(RobotOnTyres& robot, const BodyTwist& twist) {
  robot.hold_velocity(twist, 2000);
  const double before_rad = robot.true_heading_rad();
  robot.hold_velocity(twist, 10'000);
  return (robot.true_heading_rad() - before_rad) / 10;
}

TEST(CurvatureEffect, InTheParameterACommandedCurveIsTheTrueOne) {
  for (const double omega_radps : {0.05, 0.3, -1.0}) {
    RobotOnTyres known(kE, kE), unknown(kE, 0);
    const BodyTwist twist{300'000, static_cast<std::int32_t>(std::lround(1e6 * omega_radps))};
    const double with = true_yaw_rate_radps(known, twist), ignored = true_yaw_rate_radps(unknown, twist);
    // The heading at each end may be a count off.
    EXPECT_NEAR(with, omega_radps, 2 * 0.28e-3 / 10);
    EXPECT_LT(std::abs(ignored), std::abs(with) - 3e-4) << "1 + e g of a wheelbase turns more slowly";
  }
}

// 0.75 m/s and 2 rad/s about 0.29 m are 1.04 m/s of a wheel. The widest wheelbase would make it 1.1 m/s, below over_speed.
TEST(CurvatureEffect, LetsARobotDriveAtBothItsLimitsWithoutOverSpeed) {
  for (const double e : {-0.2, 0.2}) {
    RobotOnTyres robot(e, e);
    robot.hold_velocity({7'500'000, 20'000'000}, 4000);
    EXPECT_FALSE(robot.has(Fault::over_speed)) << e;
    EXPECT_GT(robot.set_points().right_umps, 900'000) << e;
    EXPECT_LT(robot.set_points().right_umps, ParameterSet{}.get(Param::over_speed)) << e;
  }
}

TEST(CurvatureEffect, OfASpinFromRestIsNothingFromTheFirstTick) {
  RobotOnTyres with(kE, kE), without(0, 0);
  for (int ms = 0; ms < 1000; ++ms) {
    for (RobotOnTyres* robot : {&with, &without}) robot->hold_velocity({0, 1'000'000}, 1);
    ASSERT_EQ(with.set_points(), without.set_points()) << ms;
  }
  EXPECT_GT(without.set_points().right_umps, 0);
}

/// A disarmed robot whose encoders flicker between two counts for a minute, each 20 times a second and at random; they end
/// where they began.
double heading_after_a_minute_of_flicker_rad(double e, bool left, bool right) {
  ParameterSet set;
  set.set(Param::e, static_cast<std::int32_t>(std::lround(std::ldexp(e, 30))));
  Drive drive(set);
  tests::Seeded random(1);
  TickInput input;
  input.battery_mv = 12'000;
  for (int ms = 0; ms < 61'000; ++ms) {
    const bool settles = ms == 0 || ms >= 60'000;
    if (left && random.between(1, 50) == 1) input.counts.left ^= 1;
    if (right && random.between(1, 50) == 1) input.counts.right ^= 1;
    if (settles) input.counts = {};
    input.now_us += 1000;
    drive.advance(input);
  }
  const Pose& pose = drive.pose();
  return kTurn_rad * (pose.turns + std::ldexp(static_cast<double>(pose.theta.raw()), -64));
}

// With e = 0 what flickers cancels to the last bit. Otherwise each count turns the robot at the wheelbase of the speeds
// that it makes. Those of one wheel alone are always as curved. Of two it is by chance: 0.03 times g, of which no more than
// 0.5 comes up, of a count of 0.28 mrad, and the root of 2400 of them is 0.2 mrad.
TEST(CurvatureEffect, HardlyTurnsAStandingRobotWhoseEncodersFlicker) {
  EXPECT_EQ(heading_after_a_minute_of_flicker_rad(0, true, true), 0);
  const double one_rad = heading_after_a_minute_of_flicker_rad(kE, true, false),
               both_rad = heading_after_a_minute_of_flicker_rad(kE, true, true);
  fmt::print("  one encoder {:.3f} urad, both {:.3f} urad\n", 1e6 * one_rad, 1e6 * both_rad);
  EXPECT_LT(std::abs(one_rad), 2e-6);
  EXPECT_LT(std::abs(both_rad), 200e-6);
  EXPECT_NE(both_rad, 0);
}

}  // namespace
}  // namespace astro
