#include <gmock/gmock.h>

#include <numbers>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// Drives that end by themselves, against a simulator in fast motion.
namespace astro {
namespace {

using nlohmann::json;
using support::Outcome;
using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr double kPi = std::numbers::pi;

// The robot settles within half a millimetre and a milliradian before it calls a segment done.
constexpr double kNear_m = 0.002, kNear_rad = 0.002;

class Drive : public testing::Test {
 protected:
  json drive(Words words) const {
    words.insert(words.begin(), "drive");
    words.insert(words.end(), {"--json", "--port", simulator_.port()});
    const Outcome outcome = support::astrolabe(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return support::parse_json(outcome.out);
  }
  static void moved(const json& report, double x_m, double y_m, double theta_rad) {
    EXPECT_EQ(report["outcome"], "completed");
    EXPECT_NEAR(report["moved"]["x_m"], x_m, kNear_m);
    EXPECT_NEAR(report["moved"]["y_m"], y_m, kNear_m);
    EXPECT_NEAR(report["moved"]["theta_rad"], theta_rad, kNear_rad);
  }

  support::Simulator simulator_;
};

TEST_F(Drive, LineEndsAMetreOn) {
  const json report = drive({"line", "1"});
  moved(report, 1, 0, 0);
  EXPECT_NEAR(report["odometry"]["x_m"], 1.0, kNear_m);
}

TEST_F(Drive, LineOfNegativeLengthGoesBackwards) { moved(drive({"line", "-0.3"}), -0.3, 0, 0); }

TEST_F(Drive, SpeedIsKeptTo) {
  // 0.5 m at 0.1 m/s with ramps of 0.5 m/s^2: 5.2 s; the robot's own limit would need 2 s.
  EXPECT_NEAR(drive({"line", "0.5", "--speed", "0.1"})["duration_s"], 5.2, 0.4);
}

TEST_F(Drive, SpinTurnsOnTheSpotAndCountsWholeTurns) {
  moved(drive({"spin", "90"}), 0, 0, kPi / 2);
  moved(drive({"spin", "-720"}), 0, 0, -4 * kPi);
}

TEST_F(Drive, MovedIsSeenFromWhereTheDriveBegan) {
  drive({"spin", "90"});
  const json report = drive({"line", "0.5"});
  moved(report, 0.5, 0, 0);
  EXPECT_NEAR(report["odometry"]["y_m"], 0.5, kNear_m);
}

TEST_F(Drive, ArcEndsWhereItsCircleIs) { moved(drive({"arc", "1.5708", "90"}), 1, 1, kPi / 2); }

TEST_F(Drive, SquareAndCircleCloseInTheirOwnOdometry) {
  moved(drive({"square", "0.5", "--cw"}), 0, 0, -2 * kPi);
  moved(drive({"square", "0.5", "--ccw"}), 0, 0, 2 * kPi);
  // Slow enough for the motors: at 0.75 m/s on this radius the outer wheel would need more than 12 V.
  moved(drive({"circle", "0.5", "--cw", "--speed", "0.5"}), 0, 0, -2 * kPi);
  moved(drive({"circle", "0.3", "--turns", "2"}), 0, 0, 4 * kPi);
}

TEST_F(Drive, VelocityIsHeldForItsTimeOnTheRobotsClock) {
  const json report = drive({"velocity", "0.2", "0", "--for", "3"});
  // Ramps of 0.5 m/s^2 at both ends: 0.2 m/s for 3 s, less 0.04 m while speeding up, more 0.04 m while
  // slowing down; the end is seen within the 50 ms of a repetition, 0.01 m.
  EXPECT_NEAR(report["moved"]["x_m"], 0.6, 0.03);
  EXPECT_NEAR(report["duration_s"], 3.4, 0.2);
}

TEST_F(Drive, TextIsTwoLinesForPeople) {
  const Outcome outcome = support::astrolabe({"drive", "line", "0.2", "--port", simulator_.port()});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2) << outcome.out;
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Drive, WhatTheRobotCannotDoIsRefused) {
  const Outcome outcome = support::astrolabe({"drive", "line", "1e12", "--port", simulator_.port()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("length"));
}

TEST_F(Drive, SaysWhereTheRobotsLimitsMakeItSlowerThanAskedFor) {
  const auto said = [&](Words words) {
    words.insert(words.begin(), "drive");
    words.insert(words.end(), {"--port", simulator_.port()});
    const Outcome outcome = support::astrolabe(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_EQ(said({"line", "0.3", "--speed", "100"}),
            "the robot drives at 0.75 m/s at most, its speed_limit, and not at the 100 m/s asked for\n");
  EXPECT_EQ(said({"velocity", "5", "0", "--for", "0.2"}),
            "the robot drives at 0.75 m/s at most, its speed_limit, and not at the 5 m/s asked for\n");
  EXPECT_EQ(said({"spin", "90", "--yaw-rate", "3"}),
            "the robot turns at 2 rad/s at most, its yaw_rate_limit, and not at the 3 rad/s asked for\n");
  EXPECT_EQ(said({"circle", "0.2", "--speed", "0.5"}),
            "on the arc the robot is slower than asked for: its yaw_rate_limit is 2 rad/s, and the arc would "
            "need 2.5 rad/s\n");
  EXPECT_EQ(said({"circle", "0.25", "--speed", "0.5"}), "");
  EXPECT_EQ(said({"square", "0.3", "--speed", "0.75", "--yaw-rate", "2"}), "");
}

TEST_F(Drive, LeavesTheRobotDisarmed) {
  drive({"line", "0.1"});
  const json info =
      support::parse_json(support::astrolabe({"info", "--json", "--port", simulator_.port()}).out);
  EXPECT_EQ(info["mode"], "disarmed");
  EXPECT_EQ(info["faults"], json::array());
}

}  // namespace
}  // namespace astro
