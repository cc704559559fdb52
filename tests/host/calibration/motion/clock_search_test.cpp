#include "host/calibration/motion/clock_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <random>

#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

Trajectory drive(double offset_s, double skew, bool headings = true) {
  simulation::study::DriveModel model = astro_drive();
  model.clock_offset_s = offset_s;
  model.clock_skew = skew;
  model.headings = headings;
  return simulation::study::synthetic_drive(simulation::study::square_course(1.7, Sense::cw), model, "run",
                                            kSeed);
}

// A start for the likelihood, which pulls in from a few tenths of a second: a bin of the search will do.
constexpr double kBin_s = 0.05;

TEST(ClockSearch, FindsASmallOffset) {
  const ClockFit fit = search_clock(drive(0.12, 0), 0.29, {});
  EXPECT_NEAR(fit.offset_s, 0.12, kBin_s);
  EXPECT_EQ(fit.skew, 0);
  EXPECT_GT(fit.correlation, 0.97);
}

TEST(ClockSearch, FindsAnyOffsetAndASlowClock) {
  const ClockFit fit = search_clock(drive(482.3, -0.0235), 0.29, {});
  EXPECT_NEAR(fit.offset_s, 482.3, kBin_s);
  EXPECT_NEAR(fit.skew, -0.0235, 0.006);  // 28 s long: a tenth of a second over half of it
  EXPECT_GT(fit.correlation, 0.97);
}

TEST(ClockSearch, WorksWithPositionsAlone) {
  EXPECT_NEAR(search_clock(drive(-7.7, 0, false), 0.29, {}).offset_s, -7.7, kBin_s);
}

TEST(ClockSearch, DoesNotMindAMirroredTruth) {
  Trajectory run = drive(3, 0);
  for (BodySample& sample : run.truth) {
    sample.y_m = -sample.y_m;
    sample.theta_rad = -sample.theta_rad;
  }
  EXPECT_NEAR(search_clock(run, 0.29, {}).offset_s, 3, kBin_s);
}

TEST(ClockSearch, IsAsFastForALongSteadyDriveAndKnowsItAgain) {
  // Ten minutes of one spin: nothing varies but its ends, and the square of its samples would take seconds.
  simulation::study::DriveModel model = astro_drive();
  const Trajectory run =
      simulation::study::synthetic_drive(simulation::study::spin_course(600), model, "run", kSeed);
  const ClockFit fit = search_clock(run, 0.29, {});
  EXPECT_NEAR(fit.offset_s, 0, 0.1);
  EXPECT_GT(fit.likeness, 0.95);
}

TEST(ClockSearch, FindsNothingInCommonWithAnotherDrive) {
  Trajectory run = drive(0, 0);
  run.truth = simulation::study::synthetic_drive({{simulation::study::Leg::Kind::rest, 0, 0, 11},
                                                  {simulation::study::Leg::Kind::straight, 0.7, 0, 0},
                                                  {simulation::study::Leg::Kind::rest, 0, 0, 16}},
                                                 astro_drive(), "other", kSeed)
                  .truth;
  const ClockFit fit = search_clock(run, 0.29, {});
  EXPECT_LT(fit.correlation, 0.5);
  EXPECT_LT(fit.likeness, 0.9);
}

/// As a webcam, tags or UWB see it.
Trajectory noisy_drive(double offset_s, double skew, double truth_rate_hz, std::uint64_t seed) {
  simulation::study::DriveModel model = astro_drive();
  model.noise.sigma_xy_m = 0.05;
  model.noise.sigma_theta_rad = 3 * std::numbers::pi / 180;
  model.truth_rate_hz = truth_rate_hz;
  model.clock_offset_s = offset_s;
  model.clock_skew = skew;
  return simulation::study::synthetic_drive(simulation::study::square_course(1.7, Sense::cw), model, "run",
                                            seed);
}

// Speeds told over a second have a peak as wide; the likelihood pulls in from there.
constexpr double kNoisy_s = 0.15;

TEST(ClockSearch, FindsASmallOffsetUnderFiveCentimetresOfNoise) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const ClockFit fit = search_clock(noisy_drive(0.5, 0, 60, seed), 0.29, {});
    EXPECT_NEAR(fit.offset_s, 0.5, kNoisy_s) << seed;
    EXPECT_GT(fit.correlation, 0.9) << seed;
  }
}

TEST(ClockSearch, FindsAnyOffsetAndASlowClockUnderFiveCentimetresOfNoise) {
  for (const double rate_hz : {60.0, 10.0})
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const ClockFit fit = search_clock(noisy_drive(482.3, -0.0235, rate_hz, seed), 0.29, {});
      EXPECT_NEAR(fit.offset_s, 482.3, kNoisy_s) << rate_hz << ' ' << seed;
      EXPECT_NEAR(fit.skew, -0.0235, 0.01) << rate_hz << ' ' << seed;  // kNoisy_s over half of 28 s
      EXPECT_GT(fit.correlation, 0.9) << rate_hz << ' ' << seed;
    }
}

TEST(ClockSearch, SeesASpinByWhereTheBodyGoesRound) {
  simulation::study::DriveModel model = astro_drive();
  model.headings = false;
  model.clock_offset_s = 482.3;
  const Trajectory run =
      simulation::study::synthetic_drive(simulation::study::spin_course(19), model, "spin", kSeed);
  EXPECT_NEAR(search_clock(run, 0.29, {}).offset_s, 482.3, kBin_s);
}

TEST(ClockSearch, ExplainsAllMotionOfABodyHalfAWheelbaseOrTwoAheadWithoutHeadings) {
  // Lines, spins and rests in turn: a body thought to be anywhere else moves wrongly in every other one.
  simulation::study::Course course{{simulation::study::Leg::Kind::rest, 0, 0, 2}};
  for (int i = 0; i < 8; ++i) {
    course.push_back({simulation::study::Leg::Kind::straight, 0.2 + 0.02 * i, 0, 0});
    course.push_back({simulation::study::Leg::Kind::turn, 0, i % 2 == 0 ? 1.5 - 0.4 * i : 1.5 + 0.4 * i, 0});
    course.push_back({simulation::study::Leg::Kind::rest, 0, 0, 0.5 + 0.1 * (i % 3)});
  }
  course.push_back({simulation::study::Leg::Kind::rest, 0, 0, 2});
  for (const double lever_m : {0.145, 0.58}) {
    simulation::study::DriveModel model = quiet_drive();
    model.headings = false;
    model.lever = {lever_m, 0, 0};
    Trajectory run = simulation::study::synthetic_drive(course, model, "run", kSeed);
    for (BodySample& sample : run.truth) sample.time_s -= 40;
    const ClockFit fit = search_clock(run, 0.29, {});
    EXPECT_GT(fit.correlation, 0.99) << lever_m << ": a lever of twice that explains less than 0.92";
    EXPECT_NEAR(fit.offset_s, 40, kBin_s) << lever_m;
  }
}

Trajectory between(Trajectory run, double from_s, double to_s) {
  std::erase_if(run.wheels, [&](const WheelSample& s) { return s.time_s < from_s || s.time_s > to_s; });
  return run;
}

/// Lines, turns and rests of a robot that somebody plays with.
simulation::study::Course wandering(double duration_s) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> part(0, 1);
  simulation::study::Course course;
  for (double time_s = 0; time_s < duration_s;) {
    const double rest_s = 1 + 9 * part(random), length_m = 0.3 + 2 * part(random),
                 angle_rad = 6 * part(random) - 3;
    course.push_back({simulation::study::Leg::Kind::rest, 0, 0, rest_s});
    course.push_back({simulation::study::Leg::Kind::straight, length_m, 0, 0});
    course.push_back({simulation::study::Leg::Kind::turn, 0, angle_rad, 0});
    time_s += rest_s + length_m / 0.3 + std::abs(angle_rad) + 1;
  }
  return course;
}

TEST(ClockSearch, FindsAMinuteInATakeOfAnHour) {
  simulation::study::DriveModel model = astro_drive();
  const Trajectory hour = simulation::study::synthetic_drive(wandering(3600), model, "hour", kSeed);
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  for (const double from_s : {300.0, 1700.0, 3300.0}) {
    Trajectory run = between(hour, from_s, from_s + 60);
    for (BodySample& sample : run.truth) sample.time_s -= 5000;
    const std::clock_t start = std::clock();
    const ClockFit fit = search_clock(run, 0.29, {});
    std::printf("%.2f s\n", static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    EXPECT_NEAR(fit.offset_s, 5000, kBin_s) << from_s;
    EXPECT_FALSE(fit.rival_offset_s) << from_s;
  }
}

TEST(ClockSearch, FindsAMinuteOfTruthInADriveOfAnHour) {
  Trajectory run = simulation::study::synthetic_drive(wandering(3600), astro_drive(), "hour", kSeed);
  std::erase_if(run.truth, [](const BodySample& s) { return s.time_s < 1700 || s.time_s > 1760; });
  for (BodySample& sample : run.truth) sample.time_s -= 5000;
  const ClockFit fit = search_clock(run, 0.29, {});
  // Where the truth is: what a minute leaves open of the skew grows towards the middle of the drive.
  const double middle_s = (run.wheels.front().time_s + run.wheels.back().time_s) / 2 - fit.offset_s;
  EXPECT_NEAR(fit.robot_time_s(1730 - 5000, middle_s), 1730, kBin_s);
}

simulation::study::Course laps(int count) {
  simulation::study::Course course{{simulation::study::Leg::Kind::rest, 0, 0, 2}};
  for (int side = 0; side < 4 * count; ++side) {
    course.push_back({simulation::study::Leg::Kind::straight, 0.5, 0, 0});
    course.push_back({simulation::study::Leg::Kind::turn, 0, std::numbers::pi / 2, 0});
  }
  course.push_back({simulation::study::Leg::Kind::rest, 0, 0, 2});
  return course;
}

/// Ten laps of 17.3 s.
Trajectory ten_laps(double offset_s, double sigma_m = 5e-4) {
  simulation::study::DriveModel model = astro_drive();
  model.noise.sigma_xy_m = sigma_m;
  Trajectory run = simulation::study::synthetic_drive(laps(10), model, "laps", kSeed);
  for (BodySample& sample : run.truth) sample.time_s -= offset_s;
  return run;
}

TEST(ClockSearch, KnowsTheLapByTheRestsAroundAllOfThem) {
  // 52 s are three laps: within a second of a wrong offset of none.
  for (const double offset_s : {0.0, 52.0, 300.0})
    for (const double sigma_m : {5e-4, 0.05}) {
      const ClockFit fit = search_clock(ten_laps(offset_s, sigma_m), 0.29, {});
      EXPECT_NEAR(fit.offset_s, offset_s, kNoisy_s) << sigma_m;
      EXPECT_FALSE(fit.rival_offset_s) << offset_s << ' ' << sigma_m;
    }
}

TEST(ClockSearch, DoesNotMindATakeThatBeganEarlyAndEndedEarly) {
  // Before the robot's log begins it stands. One side less of the square would fit without leaving anything out.
  for (const double part : {0.9, 0.8, 0.7, 0.6, 0.5}) {
    Trajectory run = drive(482.3, -0.0235);
    const BodySample first = run.truth.front();
    const auto count = static_cast<std::ptrdiff_t>(part * static_cast<double>(run.truth.size()));
    std::vector<BodySample> take;
    for (double early_s = 9; early_s > 0; early_s -= 0.01)
      take.push_back({first.time_s - early_s, first.x_m, first.y_m, first.theta_rad});
    take.insert(take.end(), run.truth.begin(), run.truth.begin() + count);
    run.truth = take;
    const ClockFit fit = search_clock(run, 0.29, {});
    EXPECT_GT(fit.correlation, 0.97) << part;
    EXPECT_FALSE(fit.rival_offset_s) << part;
    EXPECT_NEAR(fit.offset_s, 482.3, 0.15) << part << ", skew " << fit.skew;
  }
}

TEST(ClockSearch, SaysWhenAnyLapWouldDo) {
  const ClockFit fit = search_clock(between(ten_laps(300), 60, 110), 0.29, {});
  ASSERT_TRUE(fit.rival_offset_s);
  EXPECT_GT(std::abs(*fit.rival_offset_s - fit.offset_s), 4);  // a side of the square
}

TEST(ClockSearch, TakesTheLapThatClocksSideBySideSpeakFor) {
  const ClockFit fit = search_clock(between(ten_laps(0.3), 60, 110), 0.29, {});
  EXPECT_NEAR(fit.offset_s, 0.3, kBin_s);
  EXPECT_FALSE(fit.rival_offset_s);
}

}  // namespace
}  // namespace astro::calibration
