#include "host/simulation/study/synthetic_drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace astro::simulation::study {
namespace {

using calibration::BodySample;
using calibration::EndPose;

using calibration::Trajectory;
using calibration::WheelFactors;
using calibration::WheelSample;
using std::numbers::pi;

const WheelFactors kBelieved{1.002, 0.997, 0.290};
const WheelFactors kOther{1.007, 1.003, 0.287};

DriveModel without_noise(const WheelFactors& carried, const WheelFactors& actual) {
  DriveModel model;
  model.loaded = carried;
  model.actual = actual;
  model.noise = {0, 0, 0};
  return model;
}

double mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(values.size());
}

// Four standard errors of a variance that is estimated from so many normal values, relative.
double tolerance_of(std::size_t values) { return 4 * std::sqrt(2.0 / static_cast<double>(values)); }

TEST(SyntheticDrive, OfARobotThatKnowsItselfClosesItsSquare) {
  for (const Sense sense : {Sense::cw, Sense::ccw}) {
    const Trajectory run =
        synthetic_drive(square_course(2, sense), without_noise(kBelieved, kBelieved), "run", 1);
    const BodySample &start = run.truth.front(), &end = run.truth.back();
    EXPECT_NEAR(end.x_m, start.x_m, 1e-9);  // rounding of thousands of steps
    EXPECT_NEAR(end.y_m, start.y_m, 1e-9);
    EXPECT_NEAR(std::remainder(end.theta_rad - start.theta_rad, 2 * pi), 0, 1e-9);
  }
}

TEST(SyntheticDrive, EndsWhereTheReplayOfItsSquareEnds) {
  for (const Sense sense : {Sense::cw, Sense::ccw}) {
    const Trajectory run =
        synthetic_drive(square_course(2, sense), without_noise(kBelieved, kOther), "run", 1);
    const EndPose driven = end_error(run, kBelieved), exact = replay_square(2, sense, kBelieved, kOther);
    // Counts at 100 Hz blur each corner by what the robot does in 10 ms, which is some nanometres.
    EXPECT_NEAR(driven.x_m, exact.x_m, 1e-7);
    EXPECT_NEAR(driven.y_m, exact.y_m, 1e-7);
    EXPECT_NEAR(driven.theta_rad, exact.theta_rad, 1e-7);
  }
}

TEST(SyntheticDrive, WheelsSlipWithAVarianceOfKTimesTheirTravel) {
  constexpr int kRuns = 1000, kFirstSeed = 100;
  constexpr double kLength_m = 1, kAngle_rad = 4;
  const double b_m = kBelieved.b_m;
  DriveModel model = without_noise(kBelieved, kBelieved);
  model.noise.K_m = 1e-6;
  model.truth_rate_hz = 2;
  std::vector<double> along_m, turned_rad, spun_rad;
  for (int i = 0; i < kRuns; ++i) {
    const Trajectory line = synthetic_drive(line_course(kLength_m), model, "line", kFirstSeed + i);
    const Trajectory spin = synthetic_drive(spin_course(kAngle_rad), model, "spin", kFirstSeed + i);
    along_m.push_back(line.truth.back().x_m - kLength_m);
    turned_rad.push_back(line.truth.back().theta_rad);
    spun_rad.push_back(std::remainder(spin.truth.back().theta_rad - kAngle_rad, 2 * pi));
  }
  // Travel counts in nominal metres, and here c is within 0.3 % of 1.
  const double K_m = model.noise.K_m, tolerance = tolerance_of(kRuns) + 0.003;
  EXPECT_NEAR(mean_square(along_m) / (K_m * kLength_m / 2), 1, tolerance);
  EXPECT_NEAR(mean_square(turned_rad) / (2 * K_m * kLength_m / (b_m * b_m)), 1, tolerance);
  EXPECT_NEAR(mean_square(spun_rad) / (K_m * kAngle_rad / b_m), 1, tolerance)
      << "each wheel of a spin travels b / 2 times the angle";
}

TEST(SyntheticDrive, TruthScattersAsItsNoiseModelSays) {
  DriveModel model = without_noise(kBelieved, kBelieved);
  model.noise = {0, 5e-4, 3e-3};
  const Trajectory run = synthetic_drive({{Leg::Kind::rest, 0, 0, 100}}, model, "rest", 5);
  std::vector<double> x, y, theta;
  for (const BodySample& sample : run.truth) {
    x.push_back(sample.x_m);
    y.push_back(sample.y_m);
    theta.push_back(sample.theta_rad);
  }
  const double tolerance = tolerance_of(run.truth.size());
  EXPECT_NEAR(mean_square(x) / (5e-4 * 5e-4), 1, tolerance);
  EXPECT_NEAR(mean_square(y) / (5e-4 * 5e-4), 1, tolerance);
  EXPECT_NEAR(mean_square(theta) / (3e-3 * 3e-3), 1, tolerance);
}

TEST(SyntheticDrive, IsTheSameForEqualSeedsAndAnotherForOthers) {
  DriveModel model;
  model.loaded = model.actual = kBelieved;
  const auto drive = [&](std::uint64_t seed) {
    return synthetic_drive(square_course(1, Sense::cw), model, "run", seed);
  };
  const Trajectory a = drive(3), b = drive(3), c = drive(4);
  ASSERT_EQ(a.truth.size(), b.truth.size());
  for (std::size_t i = 0; i < a.truth.size(); ++i) {
    EXPECT_EQ(a.truth[i].x_m, b.truth[i].x_m);
    EXPECT_EQ(a.truth[i].theta_rad, b.truth[i].theta_rad);
  }
  EXPECT_NE(a.truth.back().x_m, c.truth.back().x_m);
}

TEST(SyntheticDrive, ALeverArmMovesTheBodyWithTheRobot) {
  DriveModel model = without_noise(kBelieved, kOther);
  const Trajectory robot = synthetic_drive(circle_course(1, 2 * pi), model, "run", 1);
  model.lever = {0.05, -0.03, 0.4};
  const Trajectory body = synthetic_drive(circle_course(1, 2 * pi), model, "run", 1);
  ASSERT_EQ(body.truth.size(), robot.truth.size());
  for (std::size_t i = 0; i < robot.truth.size(); ++i) {
    const BodySample& r = robot.truth[i];
    const double c = std::cos(r.theta_rad), s = std::sin(r.theta_rad);
    EXPECT_NEAR(body.truth[i].x_m, r.x_m + c * 0.05 + s * 0.03, 1e-12);
    EXPECT_NEAR(body.truth[i].y_m, r.y_m + s * 0.05 - c * 0.03, 1e-12);
    EXPECT_NEAR(std::remainder(body.truth[i].theta_rad - r.theta_rad - 0.4, 2 * pi), 0, 1e-12);
  }
}

// Where the left wheel is at a moment of the robot's clock, between two counts.
double left_at(const std::vector<WheelSample>& wheels, double time_s) {
  const auto after = std::upper_bound(wheels.begin(), wheels.end(), time_s,
                                      [](double t, const WheelSample& sample) { return t < sample.time_s; });
  if (after == wheels.begin()) return after->left_m;
  if (after == wheels.end()) return wheels.back().left_m;
  const WheelSample &a = *(after - 1), &b = *after;
  return a.left_m + (b.left_m - a.left_m) * (time_s - a.time_s) / (b.time_s - a.time_s);
}

TEST(SyntheticDrive, TheTrackersClockIsBehindByTheOffsetAndDriftsByTheSkew) {
  const WheelFactors ideal{1, 1, 0.290};
  DriveModel model = without_noise(ideal, ideal);
  model.clock_offset_s = 0.25;
  model.clock_skew = 0.01;
  const Trajectory run = synthetic_drive(line_course(3), model, "line", 1);
  const double middle_s = (run.wheels.front().time_s + run.wheels.back().time_s) / 2;
  const auto robot_time = [&](double t) { return middle_s + 1.01 * (t + 0.25 - middle_s); };
  int moving = 0;
  for (const BodySample& sample : run.truth) {
    // Along a line x is the wheels' travel; counts at 100 Hz cut corners of at most 0.5 m/s^2 (10 ms)^2 / 8.
    EXPECT_NEAR(sample.x_m, left_at(run.wheels, robot_time(sample.time_s)), 1e-5) << sample.time_s;
    moving += sample.x_m > 0.1 && sample.x_m < 2.9 ? 1 : 0;
  }
  EXPECT_GT(moving, 300) << "some 10 s of driving at 60 Hz";
}

TEST(SyntheticDrive, CountsAndTruthComeAtTheirRates) {
  DriveModel model = without_noise(kBelieved, kBelieved);
  model.count_rate_hz = 50;
  model.truth_rate_hz = 20;
  model.headings = false;
  model.metres_per_count = 1e-3;
  const Trajectory run = synthetic_drive(line_course(1), model, "line", 1);
  for (std::size_t i = 0; i < run.wheels.size(); ++i) {
    EXPECT_DOUBLE_EQ(run.wheels[i].time_s, static_cast<double>(i) / 50);
    const double counts = run.wheels[i].left_m / 1e-3;
    EXPECT_NEAR(counts, std::round(counts), 1e-9);
  }
  for (std::size_t i = 1; i < run.truth.size(); ++i)
    EXPECT_NEAR(run.truth[i].time_s - run.truth[i - 1].time_s, 0.05, 1e-12);
  EXPECT_TRUE(std::isnan(run.truth.front().theta_rad));
}

TEST(SyntheticDrive, KeepsToItsSpeeds) {
  DriveModel model = without_noise(kBelieved, kBelieved);
  // Wheels at rest 2 x 1 s, and a trapezoid: 3 m at 0.3 m/s and one ramp of 0.6 s; 6 rad at 1 rad/s and 0.5
  // s.
  const auto seconds = [&](const Course& course) {
    return synthetic_drive(course, model, "run", 1).wheels.back().time_s;
  };
  EXPECT_NEAR(seconds(line_course(3)), 2 + 10 + 0.6, 0.02);  // two samples of 10 ms
  EXPECT_NEAR(seconds(spin_course(-6)), 2 + 6 + 0.5, 0.02);
  EXPECT_NEAR(seconds(circle_course(0.1, 6)), 2 + 6 + 0.5, 0.02) << "the yaw rate limits a tight circle";
}

}  // namespace
}  // namespace astro::simulation::study
