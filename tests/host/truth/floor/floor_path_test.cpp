#include "host/truth/floor/floor_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "host/base/error.hpp"
#include "host/truth/files/rotations.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::truth {
namespace {

using support::ThrowsTelling;

constexpr double kPi = std::numbers::pi;

struct Drive {
  BodyTrack track;                  // z up
  std::vector<WheelMotion> wheels;  // 50 Hz, on a clock that is 3 s ahead
};

/// An S: rest, a left arc of 1.5 turns, a straight, a right arc of half a turn, rest; tracker's noise 0.1 mm, tilt by
/// 2 degrees.
Drive s_drive() {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0, 1e-4);
  Drive drive;
  drive.track.name = "astro";
  drive.track.facts.rotation_kind = RotationKind::quaternion;
  drive.track.facts.length_unit = "m";
  double x = 1, y = 2, heading = 0.3;
  for (int i = 0; i < 2600; ++i) {
    const double t = 0.01 * i;
    const double speed = t > 2 && t < 24 ? 0.3 : 0;
    const double rate = speed == 0 ? 0 : t < 14 ? 3 * kPi / 12 : t < 18 ? 0 : -kPi / 6;
    if (i % 2 == 0) drive.wheels.push_back({t + 3, speed, rate});
    const Quaternion q = from_euler("Z", {0, 0, heading}) * from_euler("X", {0.035, 0, 0});
    TrackedPose sample;
    sample.time_ns = i * std::int64_t{10'000'000};
    sample.pose = {x + normal(random), y + normal(random), 0.2 + normal(random), 0, 0, 0, 1};
    set_rotation(sample.pose, i % 7 == 0 ? Quaternion{-q.x, -q.y, -q.z, -q.w} : q);
    drive.track.samples.push_back(sample);
    x += 0.01 * speed * std::cos(heading);
    y += 0.01 * speed * std::sin(heading);
    heading += 0.01 * rate;
  }
  return drive;
}

/// Every pose seen from another frame: p -> rotation * p.
BodyTrack rotated(BodyTrack track, const Quaternion& rotation) {
  for (TrackedPose& sample : track.samples) {
    Pose3& p = sample.pose;
    const Quaternion moved = rotation * Quaternion{p.x_m, p.y_m, p.z_m, 0} * conjugate(rotation);
    p.x_m = moved.x;
    p.y_m = moved.y;
    p.z_m = moved.z;
    set_rotation(p, rotation * rotation_of(p));
  }
  return track;
}

double turned(const FloorPath& path) {
  return path.samples.back().theta_rad - path.samples.front().theta_rad;
}

TEST(FloorPath, HeadingsGoOnOverWholeTurnsAndIgnoreTiltAndSign) {
  const FloorPath path = place_on_floor(s_drive().track);
  EXPECT_NEAR(turned(path), 2 * kPi, 0.02);  // 3 pi to the left, then pi to the right; steps of 10 ms
  EXPECT_NEAR(path.findings.up[2], 1, 1e-6);
  EXPECT_FALSE(path.findings.mirrored);
  EXPECT_GT(path.findings.handedness, 0.5);
}

TEST(FloorPath, AYUpFrameGivesTheSameDrive) {
  const Drive drive = s_drive();
  const BodyTrack y_up = rotated(drive.track, from_euler("X", {-kPi / 2, 0, 0}));
  const FloorPath path = place_on_floor(y_up, drive.wheels), same = place_on_floor(drive.track, drive.wheels);
  EXPECT_NEAR(path.findings.up[1], 1, 1e-6);
  for (std::size_t i = 0; i < path.samples.size(); i += 100) {
    ASSERT_NEAR(path.samples[i].x_m, same.samples[i].x_m, 1e-3);  // the plane is fitted to noise of 0.1 mm
    ASSERT_NEAR(path.samples[i].y_m, same.samples[i].y_m, 1e-3);
  }
  EXPECT_NEAR(turned(path), turned(same), 1e-3);
}

TEST(FloorPath, AnyFrameGivesTheSameTurnAndLength) {
  const Drive drive = s_drive();
  const FloorPath tilted =
      place_on_floor(rotated(drive.track, from_euler("XYZ", {0.7, -0.4, 2})), drive.wheels);
  const FloorPath level = place_on_floor(drive.track, drive.wheels);
  EXPECT_NEAR(turned(tilted), turned(level), 1e-3);
  EXPECT_NEAR(tilted.findings.path_m, level.findings.path_m, 1e-2);
}

TEST(FloorPath, AFrameThatIsUpsideDownIsToldByTheWheels) {
  const Drive drive = s_drive();
  const BodyTrack down = rotated(drive.track, from_euler("X", {kPi, 0, 0}));
  const FloorPath path = place_on_floor(down, drive.wheels);
  EXPECT_TRUE(path.findings.reversed);
  EXPECT_FALSE(path.findings.mirrored);
  EXPECT_NEAR(turned(path), 2 * kPi, 0.02);
  EXPECT_NEAR(turned(place_on_floor(down)), -2 * kPi, 0.02) << "without wheels nothing shows it";
  EXPECT_LT(path.findings.up[2], -0.999);
}

TEST(FloorPath, ReflectedPositionsShowWithoutWheels) {
  Drive drive = s_drive();
  const FloorPath right = place_on_floor(drive.track, drive.wheels);
  for (TrackedPose& sample : drive.track.samples) sample.pose.y_m = -sample.pose.y_m;
  const FloorPath path = place_on_floor(drive.track, drive.wheels);
  EXPECT_TRUE(path.findings.mirrored);
  EXPECT_LT(path.findings.handedness, -0.5);
  EXPECT_NEAR(turned(path), turned(right), 1e-3);
  EXPECT_NEAR(path.samples[1300].y_m, right.samples[1300].y_m, 1e-3);
}

TEST(FloorPath, PositionsAndOrientationsOfDifferentFramesAreRefused) {
  const Drive drive = s_drive();
  BodyTrack mixed = rotated(drive.track, from_euler("X", {-kPi / 2, 0, 0}));
  for (std::size_t i = 0; i < mixed.samples.size(); ++i)
    set_rotation(mixed.samples[i].pose, rotation_of(drive.track.samples[i].pose));
  EXPECT_THAT(
      [&] { place_on_floor(mixed, drive.wheels); },
      ThrowsTelling(FloorProblem::frames_differ, "astro", "(0.00, 1.00, 0.00)", "(0.00, 0.00, 1.00)", "90"));
}

TEST(FloorPath, AMissingUnitOfLengthIsInferredFromTheWheels) {
  Drive drive = s_drive();
  drive.track.facts.length_unit = "";
  for (TrackedPose& sample : drive.track.samples) {
    sample.pose.x_m *= 1000;
    sample.pose.y_m *= 1000;
    sample.pose.z_m *= 1000;
  }
  const FloorPath path = place_on_floor(drive.track, drive.wheels);
  EXPECT_EQ(path.findings.unit_ratio, 1000);
  EXPECT_EQ(path.findings.length_factor, 0.001);
  EXPECT_NEAR(path.findings.path_m, 6.6, 0.1);  // 22 s at 0.3 m/s
  drive.track.facts.length_unit = "m";
  const FloorPath stated = place_on_floor(drive.track, drive.wheels);
  EXPECT_EQ(stated.findings.unit_ratio, 1000);
  EXPECT_EQ(stated.findings.length_factor, 1) << "stated by the file, so it is only reported";
  EXPECT_THAT(stated.findings.remarks.at(0), support::Tells(FloorRemark::units_differ, testing::_));
  ASSERT_TRUE(stated.findings.clock.has_value());
  EXPECT_NEAR(stated.findings.clock->offset_s, 3, 0.02);
}

TEST(FloorPath, WhatIsGivenIsNotInferred) {
  const Drive drive = s_drive();
  FloorChoices choices;
  choices.up = Direction3{0, 0, -2};
  choices.length_factor = 0.5;
  choices.mirrored = false;
  const FloorPath path = place_on_floor(drive.track, drive.wheels, choices);
  EXPECT_EQ(path.findings.up, (Direction3{0, 0, -1}));
  EXPECT_NEAR(turned(path), -2 * kPi, 0.02);
  EXPECT_LT(path.findings.turning_correlation, -0.9);
  EXPECT_NEAR(path.findings.path_m, 3.3, 0.05);
  EXPECT_FALSE(path.findings.remarks.empty());
}

TEST(FloorPath, PositionsAloneGiveNoHeadings) {
  Drive drive = s_drive();
  drive.track.facts.rotation_kind = RotationKind::none;
  for (TrackedPose& sample : drive.track.samples) set_rotation(sample.pose, {});
  const FloorPath path = place_on_floor(drive.track, drive.wheels);
  EXPECT_TRUE(std::isnan(path.samples[0].theta_rad));
  EXPECT_GT(path.findings.turning_correlation, 0.8) << "the path itself turns as the wheels do";
}

/// Three squares of 2 m one way round with spins at the corners, as a tracker of positions sees a point so far ahead of the axle.
Drive squares_seen_at(double ahead_m, double left_m = 0, double wheelbase_error = 0) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0, 2e-3);
  Drive drive;
  drive.track.name = "astro";
  drive.track.facts.length_unit = "m";
  double x = 0, y = 0, heading = 0;
  for (int i = 0; i < 11500; ++i) {
    const double t = 0.01 * i, in_side = std::fmod(t, 9.5);  // a line of 8 s, then a spin of 1.5 s
    const double speed = in_side < 8 ? 0.25 : 0, rate = speed == 0 ? kPi / 3 : 0;
    if (i % 2 == 0) drive.wheels.push_back({t + 3, speed, rate * (1 + wheelbase_error)});
    const double c = std::cos(heading), s = std::sin(heading);
    drive.track.samples.push_back({i * std::int64_t{10'000'000},
                                   {x + ahead_m * c - left_m * s + normal(random),
                                    y + ahead_m * s + left_m * c + normal(random), 0.2, 0, 0, 0, 1}});
    x += 0.01 * speed * c;
    y += 0.01 * speed * s;
    heading += 0.01 * rate;
  }
  return drive;
}

TEST(FloorPath, OfAPointAheadOfTheAxleTurnsAsTheWheelsDo) {
  for (const double ahead_m : {-0.02, 0.012, 0.016, 0.3})
    for (const double wheelbase_error : {0.0, 0.2}) {
      Drive drive = squares_seen_at(ahead_m, 0, wheelbase_error);
      const FloorPath path = place_on_floor(drive.track, drive.wheels);
      EXPECT_FALSE(path.findings.turns_against_wheels) << ahead_m << ' ' << wheelbase_error;
      for (TrackedPose& sample : drive.track.samples) sample.pose.y_m = -sample.pose.y_m;
      const FloorPath mirrored = place_on_floor(drive.track, drive.wheels);
      EXPECT_TRUE(mirrored.findings.turns_against_wheels) << ahead_m << ' ' << wheelbase_error;
    }
}

TEST(FloorPath, AStraightDriveWithoutATurnShowsNoUpAxis) {
  Drive drive = s_drive();
  drive.track.samples.resize(150);  // at rest
  EXPECT_THAT([&] { place_on_floor(drive.track); }, ThrowsTelling(FloorProblem::no_up_axis, "astro"));
}

TEST(FloorPath, InvalidSamplesStayInvalidAndNothingIsInterpolated) {
  Drive drive = s_drive();
  for (std::size_t i = 800; i < 900; ++i)
    drive.track.samples[i] = {drive.track.samples[i].time_ns, {}, false};
  const FloorPath path = place_on_floor(drive.track, drive.wheels);
  ASSERT_EQ(path.samples.size(), drive.track.samples.size());
  for (std::size_t i = 800; i < 900; ++i) ASSERT_FALSE(path.samples[i].valid);
  EXPECT_EQ(path.samples[800].time_us, 8'000'000);
  EXPECT_NEAR(turned(path), 2 * kPi, 0.02);
}

}  // namespace
}  // namespace astro::truth
