#include "host/truth/scanners/rplidar_driver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/host/truth/scanners/scanner_on_desk.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::truth::rplidar {
namespace {

using namespace std::chrono_literals;
using support::Tells;
using support::ThrowsTelling;

std::shared_ptr<ScannerOnDesk> desk() { return std::make_shared<ScannerOnDesk>(); }
Driver driver_of(const std::shared_ptr<ScannerOnDesk>& desk) {
  return Driver(std::make_unique<LineOnDesk>(desk));
}

std::vector<lidar::Scan> scans_of(Driver& driver, const ScannerOnDesk& desk,
                                  std::chrono::microseconds duration) {
  std::vector<lidar::Scan> scans;
  for (const std::int64_t until_us = desk.now_us + duration.count(); desk.now_us < until_us;)
    for (const lidar::Scan& scan : driver.poll(50ms)) scans.push_back(scan);
  return scans;
}

/// How far the farthest point of a scan is from the walls, and how many beams see something.
struct Fit {
  double worst_m = 0;
  int seen = 0;
};

Fit fit_of(const lidar::Scan& scan, const Pose2& robot) {
  Fit fit;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (std::isnan(scan.ranges_m[i])) continue;
    const double angle_rad = scan.first_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
    const double range_m = scan.ranges_m[i];
    const Point2 point = robot * Point2{range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)};
    fit.worst_m = std::max(fit.worst_m, ScannerOnDesk::off_walls_m(point));
    ++fit.seen;
  }
  return fit;
}

/// Angles of 1/64 degree at 4.7 m, met at up to 70 degrees, ranges of 1/4 or 1 mm; corners are cut by the line between two beams:
/// half of 4.7 m times the angle between two beams.
constexpr double kOnWall_m = 0.045;

void expect_good(const std::vector<lidar::Scan>& scans, const ScannerOnDesk& desk, int beams) {
  for (const lidar::Scan& scan : scans) {
    const Fit fit = fit_of(scan, desk.robot);
    EXPECT_LT(fit.worst_m, kOnWall_m);
    EXPECT_GE(fit.seen, beams - 8);  // at the four corners of the room two beams may lie on two walls
    EXPECT_EQ(scan.ranges_m.size(), static_cast<std::size_t>(beams));
    EXPECT_NEAR(scan.angle_step_rad, -2 * std::numbers::pi / beams, 1e-6);
  }
}

TEST(RplidarDriver, FindsTheSpeedAndScansAtIt) {
  for (const unsigned baud : {115'200U, 256'000U, 460'800U}) {
    const auto on = desk();
    on->right_baud = baud;
    Driver driver = driver_of(on);
    EXPECT_EQ(driver.baud(), baud);
    EXPECT_EQ(driver.info().name(), "A1M8");
    EXPECT_TRUE(on->dtr_runs_motor);
    const auto scans = scans_of(driver, *on, 2s);
    EXPECT_NEAR(static_cast<double>(scans.size()), 10, 1.01);  // 11 turns, of which the first is not whole
    expect_good(scans, *on, 360);
  }
}

TEST(RplidarDriver, UnderstandsTheExpressFormsToo) {
  for (const AnswerType form : {AnswerType::capsules, AnswerType::dense_capsules}) {
    simulation::RplidarConfig config;
    config.beams_for_node = 2;
    config.express = form;
    const auto on = std::make_shared<ScannerOnDesk>(config, ScannerOnDesk::exact(720));
    Driver driver = driver_of(on);
    const auto scans = scans_of(driver, *on, 2s);
    EXPECT_GE(scans.size(), 8U);
    expect_good(scans, *on, 720);
  }
}

/// By how much a scan's stamp is later than that of the scanner's own scan next to it.
double late_s(const lidar::Scan& scan, const ScannerOnDesk& desk) {
  double nearest_s = 1;
  for (const lidar::Scan& made : desk.scans) {
    const double apart_s = 1e-9 * static_cast<double>(scan.time_ns - made.time_ns);
    if (std::abs(apart_s) < std::abs(nearest_s)) nearest_s = apart_s;
  }
  return nearest_s;
}

// The virtual scanner sends some beam at once, and the driver takes off what a real one would take: one and a half measurements, and
// ten bits for each of five bytes.
constexpr double kSendsEarlier_s = -1.5 / (5.5 * 360) - 50.0 / 115'200;

TEST(RplidarDriver, StampsEachScanByItsFirstBeamThoughTheAdapterPassesBytesOnInBursts) {
  const auto on = desk();
  on->burst_us = 16'000;
  Driver driver = driver_of(on);
  const auto scans = scans_of(driver, *on, 30s);
  ASSERT_GT(scans.size(), 150U);
  // While the first scans come, bursts of 16 ms leave the rate open by 1 %, which is 2 ms over a turn.
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(late_s(scans[i], *on), kSendsEarlier_s, 0.004);
  for (std::size_t i = 10; i < scans.size(); ++i) {
    EXPECT_NEAR(late_s(scans[i], *on), kSendsEarlier_s, 0.0004);
    EXPECT_NEAR(scans[i].beam_interval_s, 1 / (5.5 * 360), 1e-6);
  }
}

TEST(RplidarDriver, StampsEachScanByItsFirstBeamThoughTheComputerLooksLate) {
  const auto on = desk();
  on->most_late_ms = 20;
  Driver driver = driver_of(on);
  const auto scans = scans_of(driver, *on, 60s);
  ASSERT_GT(scans.size(), 300U);
  // A quarter of the lateness. A clock that trusts single arrivals is off by all of it.
  for (std::size_t i = 50; i < scans.size(); ++i) EXPECT_NEAR(late_s(scans[i], *on), kSendsEarlier_s, 0.005);
}

TEST(RplidarDriver, StampsScansInOrderAndInTimeThoughBytesAreLostWhileTheComputerLooksElsewhere) {
  const auto on = desk();
  Driver driver = driver_of(on);
  std::vector<lidar::Scan> scans = scans_of(driver, *on, 3s);
  for (int time = 0; time < 5; ++time) {
    for (int ms = 0; ms < 2500; ++ms) on->step();  // several reads of what fits into one
    on->at_host.erase(on->at_host.begin() + 1001, on->at_host.begin() + 1008);
    for (lidar::Scan& scan : scans_of(driver, *on, 2s)) scans.push_back(std::move(scan));
  }
  ASSERT_GT(scans.size(), 90U);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_TRUE(i == 0 || scans[i].time_ns > scans[i - 1].time_ns);
    // Nobody knows how many measurements the lost bytes were: two of 5 bytes, 1 ms.
    EXPECT_NEAR(late_s(scans[i], *on), kSendsEarlier_s, 0.004);
  }
}

TEST(RplidarDriver, LeavesOutTurnsWithDamageAndGoesOn) {
  const auto on = desk();
  Driver driver = driver_of(on);
  on->damage_every = 6007;  // one byte in 3.3 turns
  const auto scans = scans_of(driver, *on, 20s);
  EXPECT_GT(scans.size(), 50U);
  EXPECT_LT(scans.size(), 108U);
  for (const lidar::Scan& scan : scans) EXPECT_EQ(scan.ranges_m.size(), 360U);
}

TEST(RplidarDriver, StopsScanAndMotorAtTheEnd) {
  const auto on = desk();
  {
    const Driver driver = driver_of(on);
    EXPECT_TRUE(on->device.is_scanning());
  }
  EXPECT_FALSE(on->device.is_scanning());
  EXPECT_FALSE(on->dtr_runs_motor);
}

TEST(RplidarDriver, FindsAScannerThatIsStillScanningForAProgramThatWasKilled) {
  const auto on = desk();
  on->device.receive(request(Command::scan));
  Driver driver = driver_of(on);
  EXPECT_FALSE(scans_of(driver, *on, 1s).empty());
}

TEST(RplidarDriver, SaysThatNobodyAnswers) {
  const auto on = desk();
  on->has_power = false;
  EXPECT_THAT([&] { driver_of(on); },
              ThrowsTelling(ScannerProblem::silent, "/dev/scanner", "115200, 256000 and 460800"));
}

TEST(RplidarDriver, SaysThatAnotherDeviceIsThere) {
  const auto on = desk();
  on->right_baud = 9600;
  on->device.receive(request(Command::scan));  // so that bytes come, at a speed that nobody tries
  EXPECT_THAT([&] { driver_of(on); }, ThrowsTelling(ScannerProblem::not_a_scanner));
}

TEST(RplidarDriver, ResetsAScannerThatIsNotWell) {
  simulation::RplidarConfig config;
  config.health = {HealthStatus::error, 0x8002};
  const auto on = std::make_shared<ScannerOnDesk>(config);
  Driver driver = driver_of(on);
  EXPECT_FALSE(scans_of(driver, *on, 1s).empty());
}

TEST(RplidarDriver, SaysWhatAScannerReportsThatDoesNotGetWell) {
  simulation::RplidarConfig config;
  config.health = {HealthStatus::error, 0x8002};
  config.reset_heals = false;
  const auto on = std::make_shared<ScannerOnDesk>(config);
  EXPECT_THAT([&] { driver_of(on); }, ThrowsTelling(ScannerProblem::unhealthy, "/dev/scanner", "0x8002"));
}

TEST(RplidarDriver, UsesAScannerThatOnlyWarns) {
  simulation::RplidarConfig config;
  config.health = {HealthStatus::warning, 1};
  const auto on = std::make_shared<ScannerOnDesk>(config);
  Driver driver = driver_of(on);
  EXPECT_FALSE(scans_of(driver, *on, 1s).empty());
}

TEST(RplidarDriver, SaysThatTheScannerHasStopped) {
  const auto on = desk();
  Driver driver = driver_of(on);
  EXPECT_FALSE(scans_of(driver, *on, 1s).empty());
  on->motor_turns = false;
  EXPECT_THAT([&] { scans_of(driver, *on, 5s); },
              ThrowsTelling(ScannerProblem::stopped, "/dev/scanner", "3"));
}

TEST(RplidarDriver, SaysThatTheScannerWasUnplugged) {
  const auto on = desk();
  Driver driver = driver_of(on);
  on->plugged = false;
  EXPECT_THAT([&] { driver.poll(50ms); }, ThrowsTelling(ScannerProblem::unplugged));
}

TEST(RplidarDriver, SaysThatMostOfWhatComesIsDamaged) {
  const auto on = desk();
  Driver driver = driver_of(on);
  on->damage_every = 3;
  EXPECT_THAT([&] { scans_of(driver, *on, 5s); }, ThrowsTelling(ScannerProblem::damaged));
}

}  // namespace
}  // namespace astro::truth::rplidar
