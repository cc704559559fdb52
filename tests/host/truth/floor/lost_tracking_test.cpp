#include "host/truth/floor/lost_tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "host/truth/files/motive_csv.hpp"
#include "host/truth/files/rotations.hpp"
#include "tests/host/truth/recorded_files.hpp"

namespace astro::truth {
namespace {

/// 100 Hz: a second of rest, four seconds at 0.3 m/s in a circle of 0.5 m, a second of rest; as a file has it, with
/// six decimals. `noise_m`: standard deviation per axis.
BodyTrack drive(double noise_m, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  BodyTrack track;
  track.facts.rotation_kind = RotationKind::quaternion;
  const auto rounded = [](double value) { return std::round(value * 1e6) / 1e6; };
  for (int i = 0; i < 600; ++i) {
    const double angle = std::clamp(i - 100, 0, 400) * 0.01 * 0.3 / 0.5;
    TrackedPose sample;
    sample.time_ns = i * std::int64_t{10'000'000};
    sample.pose.x_m = rounded(2 + 0.5 * std::sin(angle) + noise_m * normal(random));
    sample.pose.y_m = rounded(0.5 - 0.5 * std::cos(angle) + noise_m * normal(random));
    sample.pose.z_m = rounded(0.1 + noise_m * normal(random));
    const double heading = angle + 2 * noise_m * normal(random);
    sample.pose.qz = rounded(std::sin(heading / 2));
    sample.pose.qw = rounded(std::cos(heading / 2));
    track.samples.push_back(sample);
  }
  return track;
}

TEST(LostTracking, ACleanDriveLosesNothing) {
  for (const double noise_m : {0.0, 2e-5, 1e-4, 1e-3}) {
    BodyTrack track = drive(noise_m);
    EXPECT_EQ(mark_lost(track).all(), 0U) << noise_m;
  }
}

TEST(LostTracking, AStartThatAPersonCallsZeroIsNoLoss) {
  BodyTrack ends;
  ends.samples.resize(2);
  ends.samples[0].pose.qw = 1;
  ends.samples[1] = {.time_ns = 1'000'000'000, .pose = {.x_m = 4.02, .y_m = 0.11, .qw = 1}};
  EXPECT_EQ(mark_lost(ends).all(), 0U);
  ends.samples.push_back(ends.samples[1]);
  ends.samples[2].time_ns = 2'000'000'000;
  EXPECT_EQ(mark_lost(ends).at_zero, 1U) << "a tracker does not begin there by chance";
}

TEST(LostTracking, APoseHeldWhileTheBodyMovesIsLost) {
  BodyTrack track = drive(1e-4);
  for (std::size_t i = 301; i < 320; ++i) track.samples[i].pose = track.samples[300].pose;
  EXPECT_EQ(mark_lost(track).repeated, 19U);
  EXPECT_TRUE(track.samples[300].valid);
  EXPECT_FALSE(track.samples[301].valid);
  EXPECT_FALSE(track.samples[319].valid);
  EXPECT_TRUE(track.samples[320].valid);
}

TEST(LostTracking, APoseHeldToTheEndOfTheTrackIsLost) {
  BodyTrack track = drive(1e-4);
  track.samples.resize(400);
  for (std::size_t i = 350; i < 400; ++i) track.samples[i].pose = track.samples[349].pose;
  EXPECT_EQ(mark_lost(track).repeated, 50U);
}

TEST(LostTracking, EveryFrameWrittenTwiceIsHalfLost) {
  BodyTrack track = drive(1e-4);
  for (std::size_t i = 1; i < track.samples.size(); i += 2) track.samples[i].pose = track.samples[i - 1].pose;
  // In the four seconds of motion; at rest a repetition does no harm.
  EXPECT_NEAR(static_cast<double>(mark_lost(track).repeated), 200, 60);
}

TEST(LostTracking, TheOriginWhileTheBodyIsElsewhereIsLost) {
  BodyTrack track = drive(1e-4);
  for (std::size_t i = 200; i < 210; ++i) track.samples[i].pose = Pose3{};
  EXPECT_EQ(mark_lost(track).at_zero, 10U);
}

TEST(LostTracking, AFilledGapIsLost) {
  BodyTrack track = drive(1e-4);
  const Pose3 from = track.samples[200].pose, to = track.samples[230].pose;
  for (std::size_t i = 201; i < 230; ++i) {
    const double part = static_cast<double>(i - 200) / 30;
    Pose3& p = track.samples[i].pose;
    p.x_m = std::round((from.x_m + part * (to.x_m - from.x_m)) * 1e6) / 1e6;
    p.y_m = std::round((from.y_m + part * (to.y_m - from.y_m)) * 1e6) / 1e6;
    p.z_m = std::round((from.z_m + part * (to.z_m - from.z_m)) * 1e6) / 1e6;
  }
  EXPECT_EQ(mark_lost(track).filled, 29U);
  EXPECT_FALSE(track.samples[201].valid);
  EXPECT_TRUE(track.samples[230].valid);
}

TEST(LostTracking, AChangeOfTheQuaternionsSignIsNoLoss) {
  BodyTrack track = drive(1e-4);
  for (std::size_t i = 0; i < track.samples.size(); i += 3) {
    Pose3& p = track.samples[i].pose;
    set_rotation(p, {-p.qx, -p.qy, -p.qz, -p.qw});
  }
  EXPECT_EQ(mark_lost(track).all(), 0U);
}

TEST(LostTracking, MarkingTwiceChangesNothing) {
  BodyTrack track = drive(1e-4);
  for (std::size_t i = 301; i < 320; ++i) track.samples[i].pose = track.samples[300].pose;
  mark_lost(track);
  const LostSamples again = mark_lost(track);
  EXPECT_EQ(again.absent, 19U);
  EXPECT_EQ(again.all(), 19U);
}

TEST(LostTracking, ARealTakeHasItsEmptyCellsAndFewRepetitions) {
  const std::string path =
      test::shared_file("sousa_optiodom/square/231220200029/231220200029_run-01_opti.csv.gz");
  SKIP_WITHOUT(path);
  BodyTrack track = read_motive(test::text_of_file(path), path);
  EXPECT_EQ(track.samples.size(), 8589U);
  const LostSamples lost = mark_lost(track);
  std::printf("  absent %zu, at zero %zu, repeated %zu, filled %zu\n", lost.absent, lost.at_zero,
              lost.repeated, lost.filled);
  EXPECT_LE(lost.absent, 14U);
  EXPECT_LE(lost.repeated, 10U);  // the file has 10 equal neighbours, most of them at rest
  EXPECT_EQ(lost.at_zero + lost.filled, 0U);
}

TEST(LostTracking, AMarkerThatIsTakenForAnotherForAMomentIsLost) {
  for (const double noise_m : {0.0, 1e-4, 5e-3}) {
    BodyTrack track = drive(noise_m);
    for (std::size_t i = 250; i < 270; ++i) track.samples[i].pose.y_m += 0.3;
    const LostSamples lost = mark_lost(track);
    EXPECT_EQ(lost.jumped, 20U) << noise_m;
    EXPECT_FALSE(track.samples[250].valid || track.samples[269].valid);
    EXPECT_TRUE(track.samples[249].valid && track.samples[270].valid);
  }
}

TEST(LostTracking, ABodyThatIsCarriedAwayIsNotLost) {
  BodyTrack track = drive(1e-4);
  for (std::size_t i = 300; i < track.samples.size(); ++i) track.samples[i].pose.y_m += 0.3;
  EXPECT_EQ(mark_lost(track).jumped, 0U);
}

}  // namespace
}  // namespace astro::truth
