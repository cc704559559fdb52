#include "host/commands/robot/monitor_view.hpp"
#include "tests/support/base/columns.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace astro::commands {
namespace {

using testing::HasSubstr;
using testing::Not;

// Everything as wide as it can get.
protocol::Telemetry extreme() {
  protocol::Telemetry telemetry;
  telemetry.device_time_us = 99ULL * 3600 * 1'000'000;
  telemetry.pose = {-(std::int64_t{9999} << 40), -(std::int64_t{9999} << 40), 1, -999};
  telemetry.counts = {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min()};
  telemetry.twist = {-9'999'000, -99'999'000};
  telemetry.wheel_speed = telemetry.setpoint = {-9'999'000, -9'999'000};
  telemetry.duty = {-32768, -32768};
  telemetry.battery.mv = 99'999;
  telemetry.state = {protocol::Mode::stopping, 65535, 0};
  telemetry.fields = protocol::Telemetry::kAll;
  telemetry.fused = {0, 0, 0, 1, -999, -99'999'000, 0, -32768, protocol::GyroState::saturated, 65535};
  return telemetry;
}

TEST(MonitorPicture, FitsATerminalOf80By24) {
  LinkFigures figures;
  figures.round_trip_ms = 999;
  figures.drift = -0.05;
  figures.frames.good = 999'999;
  figures.counts.repeats = figures.counts.lost_pings = 999'999;
  const std::string picture =
      monitor_picture("ASTRO   /run/user/1000/astrolabe-1000/astro.pty", extreme(), figures);
  EXPECT_LE(std::count(picture.begin(), picture.end(), '\n'), 23);  // the cursor needs one
  EXPECT_LE(support::widest_line(picture), 80U) << picture;
}

TEST(MonitorLine, SaysModeFaultsBatteryAndPose) {
  protocol::Telemetry telemetry;
  telemetry.battery.mv = 12'040;
  EXPECT_EQ(monitor_line(telemetry, {}), "disarmed  12.04 V  x   0.000 m  y   0.000 m      0.0 deg");
  telemetry.state.latched_faults = bit(Fault::stall);
  EXPECT_THAT(monitor_line(telemetry, {}), HasSubstr("disarmed, stall"));
  LinkFigures figures;
  figures.lost = "it was unplugged";
  EXPECT_THAT(monitor_line(telemetry, figures), HasSubstr("LOST: it was unplugged"));
}

TEST(MonitorPicture, ShowsNoMinusBeforeZeros) {
  protocol::Telemetry telemetry;
  telemetry.pose = {-1, -1, 0, 0};
  telemetry.twist = {-1, -1};
  telemetry.wheel_speed = telemetry.setpoint = {-1, -1};
  telemetry.duty = {-1, -1};
  EXPECT_THAT(monitor_picture("ASTRO", telemetry, {}), Not(testing::ContainsRegex("-0[.]0+[^0-9]")));
}

TEST(MonitorPicture, SaysThatTheLinkIsLost) {
  LinkFigures figures;
  EXPECT_THAT(monitor_picture("ASTRO", {}, figures), Not(HasSubstr("LOST")));
  figures.lost = "it was unplugged";
  EXPECT_THAT(monitor_picture("ASTRO", {}, figures), HasSubstr("LOST: it was unplugged"));
}

TEST(MonitorPicture, ShowsTheGyroOfARobotThatUsesOne) {
  protocol::Telemetry telemetry;
  telemetry.fields = protocol::Telemetry::kAll;
  EXPECT_THAT(monitor_picture("ASTRO", telemetry, {}), Not(HasSubstr("gyro")));
  EXPECT_FALSE(to_json(telemetry).contains("gyro"));
  telemetry.fused.gyro = protocol::GyroState::running;
  telemetry.fused.theta = std::uint64_t{1} << 62;
  telemetry.fused.rate_uradps = 500'000;
  telemetry.fused.bias_uradps = -20'000;
  telemetry.fused.slips = 3;
  EXPECT_THAT(
      monitor_picture("ASTRO", telemetry, {}),
      testing::ContainsRegex("gyro      running +rate +[+]28.65 deg/s   heading +90.00 deg   slips 3"));
  const Json json = to_json(telemetry)["gyro"];
  EXPECT_EQ(json["state"], "running");
  EXPECT_NEAR(json["theta_rad"].get<double>(), 1.5707963, 1e-6);
  EXPECT_NEAR(json["rate_radps"].get<double>(), 0.5, 1e-9);
  EXPECT_NEAR(json["bias_radps"].get<double>(), -0.02, 1e-9);
  EXPECT_FALSE(json.contains("temperature_C")) << "this gyro does not say it";
  telemetry.fused.temperature_cC = 2534;
  EXPECT_NEAR(to_json(telemetry)["gyro"]["temperature_C"].get<double>(), 25.34, 1e-9);
}

TEST(MonitorPicture, NamesLatchedFaults) {
  protocol::Telemetry telemetry;
  telemetry.state.latched_faults = bit(Fault::stall) | bit(Fault::under_voltage);
  EXPECT_THAT(monitor_picture("ASTRO", telemetry, {}), HasSubstr("under_voltage, stall"));
}

}  // namespace
}  // namespace astro::commands
