#include "host/simulation/robot/virtual_scanner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "host/base/error.hpp"
#include "host/simulation/robot/virtual_robot.hpp"

namespace astro::simulation {
namespace {

constexpr double kPi = std::numbers::pi;
// A range is a float, so a point is where it should be to half a digit of 24 bits; 6 m there and 12 m across.
constexpr double kRounding_m = 1e-6;

const Room kBox = rectangular_room({-2, -1.5}, {4, 3});

ScannerConfig exact_scanner() {
  ScannerConfig config;
  config.range_sd = config.least_sd_m = config.missing = 0;
  return config;
}

/// How far a point is from the walls of kBox, by coordinate and not by a ray.
double off_walls_m(const Point2& p) {
  return std::min({std::abs(p.x_m + 2), std::abs(p.x_m - 4), std::abs(p.y_m + 1.5), std::abs(p.y_m - 3)});
}

/// Where beam `i` of a scan ended if its scanner was here.
Point2 end_of(const lidar::Scan& scan, std::size_t i, const Pose2& robot, const ScannerConfig& config) {
  const double angle_rad = scan.first_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
  const double range_m = scan.ranges_m[i];
  Point2 in_scanner{range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)};
  if (config.upside_down) in_scanner.y_m = -in_scanner.y_m;
  return robot * config.mount * in_scanner;
}

/// Scans of a robot that moves by `pose_at(seconds)`.
template <class PoseAt>
std::vector<lidar::Scan> scans_of(VirtualScanner& scanner, double span_s, PoseAt pose_at) {
  for (int ms = 0; ms <= span_s * 1000; ++ms)
    scanner.advance(1000ULL * static_cast<unsigned>(ms), pose_at(0.001 * ms));
  return scanner.take_scans();
}

TEST(VirtualScanner, SeesTheWallsFromItsPlaceOnTheRobotWhicheverWayItHangsAndTurns) {
  constexpr unsigned kSeed = 3;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> place(-1, 1), turn(-kPi, kPi);
  for (const bool upside_down : {false, true})
    for (const bool clockwise : {false, true}) {
      ScannerConfig config = exact_scanner();
      config.mount = {0.2 * place(random), 0.2 * place(random), turn(random)};
      config.upside_down = upside_down;
      config.clockwise = clockwise;
      const Pose2 robot{place(random), place(random), turn(random)};
      VirtualScanner scanner(kBox, config);
      const auto scans = scans_of(scanner, 0.2, [&](double) { return robot; });
      ASSERT_EQ(scans.size(), 1U);
      ASSERT_EQ(scans.front().ranges_m.size(), 360U);
      EXPECT_EQ(scans.front().angle_step_rad < 0, clockwise);
      for (std::size_t i = 0; i < 360; ++i)
        EXPECT_LT(off_walls_m(end_of(scans.front(), i, robot, config)), kRounding_m) << i;
    }
}

TEST(VirtualScanner, ShootsEachBeamFromWhereItIsAtThatTime) {
  const auto pose_at = [](double s) { return Pose2{0.3 * s, 0, 0.8 * s}; };
  const ScannerConfig config = exact_scanner();
  VirtualScanner scanner(kBox, config);
  double worst_as_if_at_once_m = 0;
  const auto scans = scans_of(scanner, 2, pose_at);
  ASSERT_EQ(scans.size(), 11U);
  for (const lidar::Scan& scan : scans)
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double first_s = 1e-9 * static_cast<double>(scan.time_ns);
      const double beam_s = first_s + static_cast<double>(i) * scan.beam_interval_s;
      EXPECT_LT(off_walls_m(end_of(scan, i, pose_at(beam_s), config)), kRounding_m);
      worst_as_if_at_once_m =
          std::max(worst_as_if_at_once_m, off_walls_m(end_of(scan, i, pose_at(first_s), config)));
    }
  EXPECT_GT(worst_as_if_at_once_m, 0.05);  // 0.18 s of driving lie between the first beam and the last
}

TEST(VirtualScanner, TurnsAtItsRateAndLosesNoTime) {
  VirtualScanner scanner(kBox, ScannerConfig{});
  const auto scans = scans_of(scanner, 60, [](double) { return Pose2{}; });
  ASSERT_EQ(scans.size(), 330U);
  for (std::size_t i = 0; i < scans.size(); ++i)
    EXPECT_NEAR(static_cast<double>(scans[i].time_ns), 1e9 / 5.5 * static_cast<double>(i), 1);
}

TEST(VirtualScanner, HasTheNoiseAndTheGapsOfItsConfiguration) {
  ScannerConfig config;
  config.missing = 0.02;
  VirtualScanner noisy(kBox, config), exact(kBox, exact_scanner());
  const auto still = [](double) { return Pose2{0.1, 0.2, 0.3}; };
  const auto scans = scans_of(noisy, 60, still), clean = scans_of(exact, 60, still);
  double square = 0;
  int seen = 0, missing = 0;
  for (std::size_t s = 0; s < scans.size(); ++s)
    for (std::size_t i = 0; i < 360; ++i) {
      const double range_m = scans[s].ranges_m[i], true_m = clean[s].ranges_m[i];
      if (std::isnan(range_m)) {
        ++missing;
        continue;
      }
      square += std::pow((range_m - true_m) / (config.range_sd * true_m), 2);
      ++seen;
    }
  // 118,800 beams: four standard errors of a variance are 1.7 %, of a share of 2 % they are 0.16 %.
  EXPECT_NEAR(square / seen, 1, 0.017);
  EXPECT_NEAR(missing / 118'800.0, 0.02, 0.0016);
}

TEST(VirtualScanner, SeesNothingNearerOrFartherThanItsRange) {
  const Room room{{{{0.1, -1}, {0.1, 1}}, {{-13, -1}, {-13, 1}}, {{-1, 2}, {1, 2}}}};
  VirtualScanner scanner(room, exact_scanner());
  const auto scans = scans_of(scanner, 0.2, [](double) { return Pose2{}; });
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_TRUE(std::isnan(scans[0].ranges_m[0]));        // too near, ahead
  EXPECT_TRUE(std::isnan(scans[0].ranges_m[180]));      // too far, behind
  EXPECT_NEAR(scans[0].ranges_m[270], 2, kRounding_m);  // clockwise: on the left
}

TEST(VirtualScanner, RepeatsItselfBitForBitWithTheSameSeedAndNotWithAnother) {
  const auto still = [](double) { return Pose2{}; };
  ScannerConfig config;
  config.missing = 0;
  VirtualScanner a(kBox, config), b(kBox, config);
  EXPECT_EQ(scans_of(a, 1, still).back().ranges_m, scans_of(b, 1, still).back().ranges_m);
  config.seed = 2;
  VirtualScanner c(kBox, config), d(kBox, ScannerConfig{.missing = 0});
  EXPECT_NE(scans_of(c, 1, still).back().ranges_m, scans_of(d, 1, still).back().ranges_m);
}

TEST(VirtualScanner, BeginsANewTurnWhenTheClockRestarts) {
  VirtualScanner scanner(kBox, exact_scanner());
  const auto still = [](double) { return Pose2{}; };
  EXPECT_EQ(scans_of(scanner, 0.25, still).size(), 1U);
  scanner.restart_clock();
  const auto scans = scans_of(scanner, 0.2, still);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].time_ns, 0);
  EXPECT_EQ(scans[0].ranges_m.size(), 360U);
}

TEST(VirtualScanner, ThatCannotExistIsRefused) {
  for (const ScannerConfig& config : {ScannerConfig{.turns_per_s = 0}, ScannerConfig{.beams = 0},
                                      ScannerConfig{.range_min_m = 3, .range_max_m = 2}})
    EXPECT_THROW(VirtualScanner(kBox, config), Error);
}

TEST(VirtualScanner, OnARobotChangesNothingElseOfIt) {
  VirtualRobot with(sim::Config{}, MocapConfig{}, kBox, ScannerConfig{}),
      without(sim::Config{}, MocapConfig{});
  for (int ms = 0; ms < 2000; ++ms) {
    with.step();
    without.step();
  }
  EXPECT_EQ(with.scanner()->take_scans().size(), 10U);  // the eleventh ends with the next millisecond
  EXPECT_EQ(without.scanner(), nullptr);
  const auto seen = with.take_truth(), alike = without.take_truth();
  ASSERT_EQ(seen.size(), alike.size());
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i].x_m, alike[i].x_m);
}

}  // namespace
}  // namespace astro::simulation
