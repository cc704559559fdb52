#include "common/control/path_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/common/control/astro_motion.hpp"
#include "tests/common/kinematics/near.hpp"

namespace astro {
namespace {

using tests::kAstro;
using tests::kMetre_nm;
using tests::kTurn_32;
using tests::Real;

Trapezoid planned(const Segment& segment) {
  Trapezoid profile;
  EXPECT_TRUE(Trapezoid::plan(segment, kAstro, profile));
  return profile;
}

/// The test has its own gains, because it tests what they do, not their tuning.
ParameterSet gains() {
  ParameterSet set;
  set.set(Param::path_k_along, 2 << 16);
  set.set(Param::path_k_cross, 20 << 16);
  set.set(Param::path_k_heading, 8 << 16);
  return set;
}

PathFollower follower_at(const Pose& pose) {
  PathFollower made;
  made.set_gains(gains());
  made.begin_path(pose);
  return made;
}

/// A robot that follows its command at once and exactly.
class Unicycle {
 public:
  explicit Unicycle(const Pose& pose) { integrator_.set_pose(pose); }
  void drive(const BodyTwist& twist) {
    integrator_.advance(
        static_cast<std::int64_t>(std::ldexp(twist.v_umps * 1e-9, 61)),
        static_cast<std::int64_t>(std::ldexp(twist.omega_uradps * 1e-9 / (2 * std::numbers::pi), 64)));
  }
  const Pose& pose() const { return integrator_.pose(); }

 private:
  ArcIntegrator integrator_;
};

Pose pose_at(Real x_m, Real y_m, Real theta_rad) {
  Pose pose;
  pose.x = std::llround(std::ldexp(x_m, Pose::kPositionBits));
  pose.y = std::llround(std::ldexp(y_m, Pose::kPositionBits));
  pose.theta = Angle{} + static_cast<std::int64_t>(std::ldexp(theta_rad / (2 * tests::kPi), 64));
  return pose;
}

struct Errors {
  Real along_m, cross_m, heading_rad;
};

Errors errors(const Pose& reference, const Pose& actual) {
  const Real dx = tests::metres(reference.x - actual.x), dy = tests::metres(reference.y - actual.y);
  const Real theta = tests::radians(reference.theta.raw());
  return {dx * std::cos(theta) + dy * std::sin(theta), dy * std::cos(theta) - dx * std::sin(theta),
          2 * tests::kPi * std::ldexp(static_cast<Real>(reference.theta - actual.theta), -64)};
}

/// The end of the reference if the robot always is where the reference is.
Pose end_of(const Segment& segment, const Pose& start) {
  PathFollower follower = follower_at(start);
  follower.begin(planned(segment));
  while (!follower.arrived()) follower.advance(follower.reference());
  return follower.reference();
}

TEST(PathFollower, TheReferenceEndsAtTheExactEndOfTheSegment) {
  tests::Seeded random(1);
  for (int i = 0; i < 100; ++i) {
    const std::int64_t shape = i % 3;
    const Segment segment{shape == 1 ? 0 : random.between(-3 * kMetre_nm, 3 * kMetre_nm),
                          shape == 0 ? 0 : random.between(-kTurn_32, kTurn_32), 0, 0};
    const Pose start = pose_at(1, -2, 0.001L * static_cast<Real>(random.between(-3000, 3000)));
    const Pose end = end_of(segment, start);
    const Real way_m = static_cast<Real>(segment.length_nm) * 1e-9L;
    const tests::ExactPose exact =
        tests::moved({tests::metres(start.x), tests::metres(start.y), tests::heading_rad(start)}, way_m,
                     2 * tests::kPi * std::ldexp(static_cast<Real>(segment.angle_32), -32));
    EXPECT_LT(tests::distance_m(end, exact), 2e-10L * std::fabs(way_m) + tests::kNotYetGiven_m) << i;
    EXPECT_EQ(end.theta - start.theta,
              static_cast<std::int64_t>(static_cast<std::uint64_t>(segment.angle_32) << 32));
  }
}

TEST(PathFollower, ASquareOfSegmentsEndsWhereItBegan) {
  PathFollower follower = follower_at({});
  Pose robot;
  for (int side = 0; side < 4; ++side) {
    for (const Segment& segment : {Segment{3 * kMetre_nm, 0, 0, 0}, Segment{0, -kTurn_32 / 4, 0, 0}}) {
      follower.begin(planned(segment));
      while (!follower.arrived()) follower.advance(robot);
    }
  }
  EXPECT_EQ(follower.reference().theta, Angle{});
  EXPECT_PRED_FORMAT3(tests::near, tests::metres(follower.reference().x), 0, 2 * tests::kNotYetGiven_m);
  EXPECT_PRED_FORMAT3(tests::near, tests::metres(follower.reference().y), 0, 2 * tests::kNotYetGiven_m);
}

TEST(PathFollower, WithoutErrorTheCommandIsTheReferencesOwnSpeed) {
  PathFollower follower = follower_at({});
  follower.begin(planned({3 * kMetre_nm, kTurn_32 / 4, 0, 0}));
  Trapezoid plan = planned({3 * kMetre_nm, kTurn_32 / 4, 0, 0});
  Real v_before = 0;
  while (!follower.arrived()) {
    const Trapezoid::Step step = plan.advance();
    // The reference is one step ahead of the robot when the error is taken: what k_along makes of that is
    // allowed.
    const PathFollower::Command command = follower.advance(follower.reference());
    const Real v_umps = std::ldexp(static_cast<Real>(step.travel), -50) * 1e9L;
    const Real omega_uradps = std::ldexp(static_cast<Real>(step.turn), -52) * 2 * tests::kPi * 1e9L;
    ASSERT_PRED_FORMAT3(tests::near, command.twist.v_umps, v_umps, 0.002L * std::fabs(v_umps) + 2);
    ASSERT_PRED_FORMAT3(tests::near, command.twist.omega_uradps, omega_uradps,
                        0.008L * std::fabs(omega_uradps) + 20);
    ASSERT_PRED_FORMAT3(tests::near, command.acceleration.v_umps, (v_umps - v_before) * 1000, 2000);
    v_before = v_umps;
  }
}

/// Drives 3 m on a path that runs 3 m forward (or back), from a robot that stands `off` its start.
Errors end_errors(const Errors& off, int direction) {
  const Pose start = pose_at(0, 0, 0.7L);
  const Real c = std::cos(0.7L), s = std::sin(0.7L);
  Unicycle robot(pose_at(-off.along_m * c + off.cross_m * s, -off.along_m * s - off.cross_m * c,
                         0.7L - off.heading_rad));
  PathFollower follower = follower_at(start);
  follower.begin(planned({direction * 3 * kMetre_nm, 0, 0, 0}));
  while (!follower.arrived()) robot.drive(follower.advance(robot.pose()).twist);
  return errors(follower.reference(), robot.pose());
}

TEST(PathFollower, DrivesEveryErrorToZeroForwardAndBackward) {
  for (const int direction : {1, -1}) {
    for (const Real sign : {1.0L, -1.0L}) {
      for (const Errors& off :
           {Errors{sign * 0.02L, 0, 0}, Errors{0, sign * 0.02L, 0}, Errors{0, 0, sign * 0.05L}}) {
        const Errors end = end_errors(off, direction);
        // 5.5 s at rates of 2 to 4 1/s leave less than a hundredth. The error is taken against where the
        // reference will be after the tick, so the robot leads by a tick's way: 0.75 mm at full speed, fading
        // with the speed.
        EXPECT_PRED_FORMAT3(tests::near, end.along_m, 0, 4e-4L) << direction << " " << off.along_m;
        EXPECT_PRED_FORMAT3(tests::near, end.cross_m, 0, 4e-4L) << direction << " " << off.cross_m;
        EXPECT_PRED_FORMAT3(tests::near, end.heading_rad, 0, 1e-3L) << direction << " " << off.heading_rad;
      }
    }
  }
}

/// The same drive with a correction in every `period`-th tick.
Errors end_errors_corrected_every(int period, const Segment& segment, const Errors& off) {
  Unicycle robot(pose_at(-off.along_m, off.cross_m, -off.heading_rad));
  PathFollower follower = follower_at({});
  follower.begin(planned(segment));
  for (int tick = 0; !follower.arrived(); ++tick)
    robot.drive(follower.advance(robot.pose(), tick % period == 0).twist);
  return errors(follower.reference(), robot.pose());
}

TEST(PathFollower, ACorrectionInEveryFifthTickEndsWhereOneInEachDoes) {
  for (const Segment& segment : {Segment{3 * kMetre_nm, 0, 0, 0}, Segment{0, kTurn_32 / 2, 0, 0},
                                 Segment{2 * kMetre_nm, -kTurn_32 / 3, 0, 0}}) {
    const Errors off{0.02L, -0.02L, 0.03L};
    const Errors each = end_errors_corrected_every(1, segment, off);
    const Errors fifth = end_errors_corrected_every(5, segment, off);
    // The errors fall with rates of 2 to 8 1/s, so a correction that is 5 ms old is at most 4 % off.
    EXPECT_PRED_FORMAT3(tests::near, fifth.along_m, each.along_m, 4e-4L);
    EXPECT_PRED_FORMAT3(tests::near, fifth.cross_m, each.cross_m, 4e-4L);
    EXPECT_PRED_FORMAT3(tests::near, fifth.heading_rad, each.heading_rad, 1e-3L);
  }
}

TEST(PathFollower, AResumedPathBeginsWithoutTheCorrectionFromBeforeThePause) {
  const Trapezoid line = planned({3 * kMetre_nm, 0, 0, 0});
  PathFollower fresh = follower_at({}), resumed = follower_at({});
  resumed.advance(pose_at(-0.01L, 0, -0.02L));
  EXPECT_NEAR(resumed.advance({}, false).twist.v_umps, 2 * 10'000, 1) << "k_along 2 1/s, held";
  resumed.resume_path();
  for (PathFollower* follower : {&fresh, &resumed}) follower->begin(line);
  for (int tick = 0; tick < 3; ++tick)
    EXPECT_EQ(resumed.advance({}, false).twist, fresh.advance({}, false).twist) << tick;
}

TEST(PathFollower, TheReferenceEndsAtTheExactEndHoweverSeldomItIsCorrected) {
  PathFollower follower = follower_at({});
  for (int side = 0; side < 4; ++side) {
    for (const Segment& segment : {Segment{3 * kMetre_nm, 0, 0, 0}, Segment{0, -kTurn_32 / 4, 0, 0}}) {
      follower.begin(planned(segment));
      for (int tick = 1; !follower.arrived(); ++tick) follower.advance({}, tick % 7 == 0);
    }
  }
  EXPECT_EQ(follower.reference().theta, Angle{});
  EXPECT_PRED_FORMAT3(tests::near, tests::metres(follower.reference().x), 0, 2 * tests::kNotYetGiven_m);
  EXPECT_PRED_FORMAT3(tests::near, tests::metres(follower.reference().y), 0, 2 * tests::kNotYetGiven_m);
}

TEST(PathFollower, IsCloseWithinHalfAMillimetreAlongAndAMilliradianWhateverTheOffsetAcross) {
  struct Case {
    Real along_m, cross_m, heading_rad;
    bool close;
  };
  for (const Case& one : {Case{0, 0, 0, true}, Case{0.00049, 0, 0, true}, Case{0.00051, 0, 0, false},
                          Case{-0.00049, 0, 0, true}, Case{-0.00051, 0, 0, false}, Case{0, 0, 0.00099, true},
                          Case{0, 0, 0.00101, false}, Case{0, 0, -0.00099, true}, Case{0, 0, -0.00101, false},
                          Case{0, 0.2, 0, true}}) {
    PathFollower follower = follower_at(pose_at(1, 2, 0));
    follower.advance(pose_at(1 - one.along_m, 2 - one.cross_m, -one.heading_rad));
    EXPECT_EQ(follower.close(), one.close) << one.along_m << ' ' << one.cross_m << ' ' << one.heading_rad;
  }
}

TEST(PathFollower, AtRestAfterArrivalItStillClosesTheGap) {
  PathFollower follower = follower_at({});
  Unicycle robot(pose_at(-0.01L, 0, -0.02L));
  EXPECT_TRUE(follower.arrived()) << "no segment yet";
  for (int tick = 0; tick < 3000; ++tick) robot.drive(follower.advance(robot.pose()).twist);
  const Errors end = errors(follower.reference(), robot.pose());
  EXPECT_PRED_FORMAT3(tests::near, end.along_m, 0, 1e-4L);
  EXPECT_PRED_FORMAT3(tests::near, end.heading_rad, 0, 1e-4L);
}

TEST(PathFollower, FarBehindItHurriesByNoMoreThanAQuarterMetresWorth) {
  PathFollower follower = follower_at({});
  const PathFollower::Command far = follower.advance(pose_at(-100, 0, 0));
  EXPECT_NEAR(far.twist.v_umps, 2 * 250'000, 1);  // k_along 2 1/s
  EXPECT_EQ(far.twist.omega_uradps, 0);
}

TEST(PathFollower, TheGreatestGainsAndErrorsSaturate) {
  ParameterSet set;
  for (const Param gain : {Param::path_k_along, Param::path_k_cross, Param::path_k_heading})
    set.set(gain, param_row(gain).maximum_raw);
  for (const Real side : {1.0L, -1.0L}) {
    PathFollower follower = follower_at({});
    follower.set_gains(set);
    follower.begin(planned({0, static_cast<std::int64_t>(side) * kTurn_32, 0, 0}));
    PathFollower::Command command;
    for (int tick = 0; tick < 1000; ++tick) {
      Pose lagging = follower.reference();
      lagging.theta = lagging.theta + static_cast<std::int64_t>(-side * 0x1p62L);
      command = follower.advance(lagging);
    }
    EXPECT_EQ(command.twist.omega_uradps, side > 0 ? INT32_MAX : INT32_MIN);
  }
}

}  // namespace
}  // namespace astro
