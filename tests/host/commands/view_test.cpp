#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "host/base/shown.hpp"
#include "host/commands/drive/drive_teleop_view.hpp"
#include "host/commands/robot/monitor_view.hpp"
#include "host/commands/shared/fault_help.hpp"
#include "host/console/console.hpp"
#include "host/console/terminal.hpp"

namespace astro::commands {
namespace {

using console::Key;
using console::SteeringWheel;
using testing::HasSubstr;
using testing::Not;

std::size_t width(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

TEST(FaultHelp, SaysSomethingAboutEveryFault) {
  for (std::size_t i = 1; i < kFaultNames.size(); ++i)
    EXPECT_GT(fault_help(static_cast<Fault>(i)).size(), 20U) << kFaultNames[i];
  EXPECT_EQ(fault_help(static_cast<Fault>(200)), "");
}

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
  for (std::size_t begin = 0, end; (end = picture.find('\n', begin)) != std::string::npos; begin = end + 1)
    EXPECT_LE(width(picture.substr(begin, end - begin)), 80U) << picture.substr(begin, end - begin);
}

std::size_t widest_line(const std::string& text) {
  std::size_t widest = 0;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    widest = std::max(widest, width(text.substr(begin, end - begin)));
  return widest;
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

// What a person needs for steering: every key, what is requested of the robot, what it does, and where it is.
void expect_all_that_steers(const std::string& picture) {
  for (const char* const word :
       {"faster", "slower, backwards", "turn left", "turn right", "stop", "quit", "-9.00 m/s", "-9.00 rad/s",
        "is -9.999", "x -999.999 m", "y -999.999 m", "heading -9999.9 deg"})
    EXPECT_THAT(picture, HasSubstr(word));
}

TEST(TeleopPicture, SaysTheSameAt40ColumnsAsAt80) {
  SteeringWheel wheel(9, 9);
  for (int i = 0; i < 5; ++i) {
    wheel.press(Key::backward);
    wheel.press(Key::right);
  }
  recording::OdometrySample at;
  at.v_mps = at.omega_radps = -9.999;
  at.x_m = at.y_m = -999.999;
  at.theta_rad = -9999.9 * std::numbers::pi / 180;
  for (const std::size_t columns : {40U, 41U, 69U, 70U, 80U, 200U}) {
    const std::string picture = teleop_picture("ASTRO", wheel, at, {columns, 24});
    EXPECT_LE(widest_line(picture), columns) << picture;
    EXPECT_LE(std::count(picture.begin(), picture.end(), '\n'), 23) << picture;
    expect_all_that_steers(picture);
  }
  EXPECT_THAT(teleop_picture("ASTRO", wheel, at, {80, 24}), HasSubstr("███████████████┃"));
}

TEST(TeleopPicture, GivesUpTheKeysBeforeTheFiguresWhereRowsAreFew) {
  for (const std::size_t columns : {40U, 80U}) {
    const std::string picture = teleop_picture("ASTRO", {0.4, 1}, {}, {columns, 10});
    EXPECT_LE(std::count(picture.begin(), picture.end(), '\n'), 9) << picture;
    EXPECT_THAT(picture, testing::AllOf(HasSubstr("odometry"), HasSubstr("heading 0.0 deg"),
                                        Not(HasSubstr("faster"))));
  }
}

TEST(WithoutMinusZero, ShowsNoSignBeforeNothingButZeros) {
  EXPECT_EQ(in_words({-4e-5, -0.0, -8e-6}), "x   0.0000 m   y   0.0000 m   heading     0.000 deg");
  EXPECT_EQ(in_words({-6e-5, -5.01e-5, -1e-5}), "x  -0.0001 m   y  -0.0001 m   heading    -0.001 deg");
  EXPECT_EQ(in_short_words({-4e-4, -0.0, -8e-4}), "x   0.000 m  y   0.000 m      0.0 deg");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(without_minus_zero(-kInfinity, 3), -kInfinity);
  EXPECT_TRUE(std::isnan(without_minus_zero(std::nan(""), 3)));
  // Nobody needs to know which way a tie is rounded: what is printed decides.
  for (const double value : {-0.5, -0.05, -0.0005, -0.25, -0.00049999}) {
    for (const int decimals : {0, 1, 2, 3}) {
      const std::string shown = fmt::format("{:.{}f}", without_minus_zero(value, decimals), decimals);
      EXPECT_EQ(shown.starts_with('-'), shown.find_first_of("123456789") != std::string::npos) << shown;
    }
  }
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

TEST(MonitorPicture, NamesLatchedFaults) {
  protocol::Telemetry telemetry;
  telemetry.state.latched_faults = bit(Fault::stall) | bit(Fault::under_voltage);
  EXPECT_THAT(monitor_picture("ASTRO", telemetry, {}), HasSubstr("under_voltage, stall"));
}

TEST(Durations, AreInUnitsThatPeopleUse) {
  EXPECT_EQ(duration_in_words(0), "0.0 s");
  EXPECT_EQ(duration_in_words(59'900'000), "59.9 s");
  EXPECT_EQ(duration_in_words(61'000'000), "1 min 01 s");
  EXPECT_EQ(duration_in_words(7'384'000'000), "2 h 03 min 04 s");
}

}  // namespace
}  // namespace astro::commands
