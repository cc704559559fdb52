#include "host/truth/live/scanner_source.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

#include "host/robot/port/open_transport.hpp"
#include "host/simulation/server/server.hpp"
#include "host/truth/live/rplidar_link.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::truth {
namespace {

using support::Tells;
using support::ThrowsTelling;
using namespace std::chrono_literals;

/// A robot that stands in a room, on a thread of its own, with the pty of its scanner.
class ServedScanner {
 public:
  ServedScanner()
      : server_(std::in_place, sim::Config(), simulation::MocapConfig(),
                simulation::ServerConfig{
                    .pty = folder_.path() / "robot.pty",
                    .room = simulation::RoomFile{simulation::rectangular_room({-2, -1.5}, {2.5, 2})},
                    .scanner_pty = port()}),
        thread_([this] { server_->run([this] { return stop_.load(); }); }) {}
  ~ServedScanner() { end(); }

  std::string port() const { return folder_.path() / "robot.pty.lidar"; }
  void end() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    server_.reset();
  }

 private:
  test::TemporaryFolder folder_;
  std::atomic<bool> stop_ = false;
  std::optional<simulation::Server> server_;
  std::thread thread_;
};

double off_walls_of_room_m(const Point2& p) {
  return std::min({std::abs(p.x_m + 2), std::abs(p.x_m - 2.5), std::abs(p.y_m + 1.5), std::abs(p.y_m - 2)});
}

std::int64_t steady_now_ns() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TEST(ScannerSource, GivesScansOfTheRoomAndNoPoses) {
  const ServedScanner served;
  ScannerSource source(std::make_unique<RplidarLink>(served.port()));
  // A busy machine measures another rate than 5.5 turns a second.
  EXPECT_THAT(source.description(),
              testing::MatchesRegex("RPLIDAR A1M8 at 115200 baud, 360 beams [0-9.]+ times a second"));
  EXPECT_EQ(source.clock(), "host");
  const std::int64_t begin_ns = steady_now_ns();
  source.begin_run();
  EXPECT_TRUE(source.poll().empty());
  const std::vector<lidar::Scan> scans = source.take_scans();
  ASSERT_FALSE(scans.empty());
  for (const lidar::Scan& scan : scans) {
    EXPECT_GE(scan.time_ns, begin_ns);
    EXPECT_LT(scan.time_ns, steady_now_ns());
    double off_m = 0;
    int seen = 0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      if (std::isnan(scan.ranges_m[i])) continue;
      const double angle_rad = scan.first_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
      const double range_m = scan.ranges_m[i];
      off_m += off_walls_of_room_m({range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)});
      ++seen;
    }
    EXPECT_GT(seen, 330);           // one beam in a hundred is missing
    EXPECT_LT(off_m / seen, 0.02);  // the noise of half a per cent of 3 m
  }
}

/// Scans that are given to it.
class GivenScans : public ScanLink {
 public:
  explicit GivenScans(lidar::Scan scan) : scan_(std::move(scan)) {}

  std::vector<lidar::Scan> poll(std::chrono::microseconds) override {
    scan_.time_ns = steady_now_ns();
    return {scan_};
  }
  std::string subject() const override { return "the given scanner"; }
  std::string doubt() const override { return "is it there?"; }
  std::string description() const override { return "given"; }

 private:
  lidar::Scan scan_;
};

TEST(ScannerSource, TurnsMirrorImagesRound) {
  lidar::Scan scan;
  scan.first_angle_rad = 0.5;
  scan.angle_step_rad = 0.01;
  scan.ranges_m = {1, 2};
  ScannerSource as_is(std::make_unique<GivenScans>(scan)),
      turned(std::make_unique<GivenScans>(scan), Mirrored::yes);
  as_is.begin_run();
  turned.begin_run();
  EXPECT_EQ(as_is.take_scans().at(0).first_angle_rad, 0.5);
  EXPECT_EQ(turned.take_scans().at(0).first_angle_rad, -0.5);
}

TEST(ScannerSource, SaysThatItsScannerIsGone) {
  ServedScanner served;
  ScannerSource source(std::make_unique<RplidarLink>(served.port()));
  served.end();
  EXPECT_THAT([&] { source.begin_run(); }, ThrowsTelling(rplidar::ScannerProblem::unplugged, served.port()));
  EXPECT_THAT([&] { source.poll(); }, ThrowsTelling(rplidar::ScannerProblem::unplugged));
  EXPECT_THAT([&] { source.take_scans(); }, ThrowsTelling(rplidar::ScannerProblem::unplugged));
}

TEST(ScannerSource, NeedsAPortThatExistsAndIsOne) {
  EXPECT_THAT([] { RplidarLink("/dev/shm/no-such-scanner"); }, ThrowsTelling(robot::PortProblem::absent));
  EXPECT_THAT([] { RplidarLink("/dev/null"); }, ThrowsTelling(robot::PortProblem::not_serial));
}

TEST(ScannerSource, IsNamedByItsPort) {
  EXPECT_EQ(scanner_port_in("lidar:/dev/ttyUSB0"), "/dev/ttyUSB0");
  for (const char* other : {"lidar:", "lidar", "vrpn://lab/ASTRO", "/dev/ttyUSB0", ""})
    EXPECT_EQ(scanner_port_in(other), std::nullopt) << other;
}

}  // namespace
}  // namespace astro::truth
