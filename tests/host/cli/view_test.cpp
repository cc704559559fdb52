#include <gmock/gmock.h>

#include <limits>

#include "host/cli/console.hpp"
#include "host/cli/fault_help.hpp"
#include "host/cli/monitor_view.hpp"
#include "host/cli/terminal.hpp"

namespace astro::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t width(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

TEST(Clipped, CountsCharactersNotBytes) {
  EXPECT_EQ(clipped("äöü", 2), "äö");
  EXPECT_EQ(clipped("█░", 5), "█░");
  EXPECT_EQ(clipped("abc", 0), "");
}

TEST(Gauge, GrowsFromTheMiddleToEitherSide) {
  EXPECT_EQ(gauge(0, 3), "░░░┃░░░");
  EXPECT_EQ(gauge(1, 3), "░░░┃███");
  EXPECT_EQ(gauge(-1, 3), "███┃░░░");
  EXPECT_EQ(gauge(0.34, 3), "░░░┃█░░");
  EXPECT_EQ(gauge(-7, 3), gauge(-1, 3));
}

TEST(Table, AlignsAsAskedAndByCharacters) {
  EXPECT_EQ(table({{"a", "bb"}, {"ccc", "d"}}), "a    bb\nccc   d\n");
  EXPECT_EQ(table({{"a", "bb"}, {"ü", "d"}}, "rl"), "a  bb\nü  d\n");
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
}  // namespace astro::cli
