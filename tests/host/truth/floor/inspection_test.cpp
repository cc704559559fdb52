#include "host/truth/floor/inspection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "tests/host/truth/files/own_recordings.hpp"
#include "tests/host/truth/recorded_files.hpp"

namespace astro::truth {
namespace {

TEST(Inspection, ListsEveryBodyWithItsGaps) {
  const Inspection found = inspect(test::kVicon, "v.csv");
  EXPECT_EQ(found.kind, FileKind::vicon);
  ASSERT_EQ(found.bodies.size(), 2U);
  const BodyInspection& astro = found.bodies[0];
  EXPECT_EQ(astro.name.name, "astro");
  EXPECT_EQ(astro.samples, 4U);
  EXPECT_EQ(astro.lost.absent, 1U);
  EXPECT_DOUBLE_EQ(astro.duration_s, 0.04);
  EXPECT_DOUBLE_EQ(astro.median_period_s, 0.01);
  EXPECT_EQ(astro.gaps, 1U);
  EXPECT_DOUBLE_EQ(astro.longest_gap_s, 0.03);
  EXPECT_FALSE(astro.noise.has_value());
}

/// At 100 Hz, as a tracker with this noise sees it. `at` gives x and yaw at a sample.
BodyTrack seen(int samples, RotationKind kind, const Pose3& noise, auto at) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 1);
  BodyTrack track;
  track.facts.rotation_kind = kind;
  for (int i = 0; i < samples; ++i) {
    const auto [x_m, yaw_rad] = at(i);
    const double angle = yaw_rad + noise.qz * normal(random);
    track.samples.push_back({i * std::int64_t{10'000'000},
                             {x_m + noise.x_m * normal(random), noise.y_m * normal(random),
                              noise.z_m * normal(random), 0, 0, std::sin(angle / 2), std::cos(angle / 2)},
                             true});
  }
  return track;
}

using Place = std::pair<double, double>;  // x, yaw

TEST(Inspection, ShowsNoRestBetweenSamplesThatAreDecadesApart) {
  BodyTrack track = seen(5, RotationKind::quaternion, {1e-4, 1e-4, 1e-4, 0, 0, 1e-3, 0}, [](int) {
    return Place{0, 0};
  });
  for (TrackedPose& sample : track.samples) sample.time_ns *= 200'000'000'000;
  const BodyInspection found = inspect(track);
  EXPECT_DOUBLE_EQ(found.median_period_s, 2e9);
  EXPECT_FALSE(found.noise);
}

TEST(Inspection, NoiseIsThatOfTheRestsAndNotOfTheDrive) {
  BodyTrack track = seen(3000, RotationKind::quaternion, {1e-4, 2e-4, 5e-5, 0, 0, 2e-3, 0}, [](int i) {
    return Place{0.003 * std::clamp(i - 1000, 0, 1000), 0};
  });
  const auto noise = inspect(track).noise;
  ASSERT_TRUE(noise.has_value());
  EXPECT_NEAR(noise->rest_s, 20, 1.5);
  // 2000 samples know a standard deviation to 1.6 %; five times that.
  EXPECT_NEAR(noise->sd_m[0], 1e-4, 8e-6);
  EXPECT_NEAR(noise->sd_m[1], 2e-4, 16e-6);
  EXPECT_NEAR(noise->sd_m[2], 5e-5, 4e-6);
  EXPECT_NEAR(noise->sd_rad, 2e-3, 1.6e-4);
}

// A stand of a good second at either end of a minute: a window in which the robot begins to move or comes to a stop counts as
// much as the few in which it stands.
TEST(Inspection, NoiseIsThatOfShortRestsWithoutTheMotionBeforeAndAfterThem) {
  for (int first = 108; first <= 145; first += 4) {
    BodyTrack track = seen(6000, RotationKind::none, {1e-4, 1e-4, 1e-4, 0, 0, 0, 0}, [&](int i) {
      const double s =
          0.01 * std::max(0, std::min(i, 6000 - i) - first);  // since it began to move, or until it stands
      const double way_m = s < 0.6 ? 0.25 * s * s : 0.09 + 0.3 * (s - 0.6);
      return Place{(i < 3000 ? 1 : -1) * way_m, 0};
    });
    const auto noise = inspect(track).noise;
    ASSERT_TRUE(noise.has_value()) << first;
    // The median of four windows or five, each of which knows it to 10 %, errs by 6 %; four times that.
    EXPECT_NEAR(noise->sd_m[0], 1e-4, 2.4e-5) << first;
  }
}

TEST(Inspection, NoiseOfASlowTrackerIsSeenInLongerWindows) {
  BodyTrack track = seen(900, RotationKind::none, {1e-3, 1e-3, 1e-3, 0, 0, 0, 0}, [](int i) {
    return Place{0.03 * std::clamp(i - 50, 0, 800), 0};
  });
  for (TrackedPose& sample : track.samples) sample.time_ns *= 10;  // 10 Hz, 5 s of rest at each end
  const auto noise = inspect(track).noise;
  ASSERT_TRUE(noise.has_value());
  // The lower median of a dozen windows, each of which knows it to 30 %, errs by 12 %; three times that.
  EXPECT_NEAR(noise->sd_m[1], 1e-3, 3.6e-4);
}

TEST(Inspection, ASpinAboutTheTrackedPointIsNoRest) {
  BodyTrack track = seen(3000, RotationKind::quaternion, {1e-4, 1e-4, 1e-4, 0, 0, 2e-3, 0}, [](int i) {
    return Place{0, 5e-3 * std::clamp(i - 1000, 0, 1000)};
  });
  const auto noise = inspect(track).noise;
  ASSERT_TRUE(noise.has_value());
  EXPECT_NEAR(noise->rest_s, 20, 1.5);
  EXPECT_NEAR(noise->sd_rad, 2e-3, 1.6e-4);  // as above
}

TEST(Inspection, ARealTakeHasTheNoiseThatIsKnownOfIt) {
  const std::string path =
      test::shared_file("sousa_optiodom/square/231220200029/231220200029_run-01_opti.csv.gz");
  SKIP_WITHOUT(path);
  const Inspection found = inspect(test::text_of_file(path), path);
  ASSERT_EQ(found.bodies.size(), 1U);
  const BodyInspection& body = found.bodies[0];
  EXPECT_EQ(body.name.name, "robot-diff");
  EXPECT_NEAR(body.duration_s, 85.88, 1e-9);
  EXPECT_EQ(body.facts.start_time, "2020-12-23T01:18:10.123");
  ASSERT_TRUE(body.noise.has_value());
  std::printf("  %.1f s of rest, sd %.3f %.3f %.3f mm, %.3f degrees; gaps %zu, longest %.2f s\n",
              body.noise->rest_s, 1e3 * body.noise->sd_m[0], 1e3 * body.noise->sd_m[1],
              1e3 * body.noise->sd_m[2], body.noise->sd_rad * 180 / 3.14159265, body.gaps,
              body.longest_gap_s);
  for (const double sd_m : body.noise->sd_m) {
    EXPECT_GT(sd_m, 0.01e-3);
    EXPECT_LT(sd_m, 0.3e-3);
  }
}

}  // namespace
}  // namespace astro::truth
