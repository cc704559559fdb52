#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "host/formats/tables/table.hpp"
#include "host/truth/files/tracker_file.hpp"
#include "host/truth/floor/floor_path.hpp"
#include "host/truth/floor/lost_tracking.hpp"
#include "tests/host/truth/recorded_files.hpp"

namespace astro::truth {
namespace {

/// The onboard log of the stadium run: speeds of the wheels, and a heading in degrees.
std::vector<WheelMotion> stadium_wheels(const std::string& text) {
  tables::Table table(text, "odometry");
  std::vector<std::array<double, 6>> rows;
  while (table.next())
    for (std::size_t column = 0; auto& value : rows.emplace_back())
      value = tables::cell_number(table.cell(column++), table.style()).value_or(0);
  const auto cell = [&](std::size_t row, std::size_t column) { return rows[row][column]; };
  std::vector<WheelMotion> wheels;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const double time_s = cell(i, 0), next_s = cell(i + 1, 0);
    if (!(next_s > time_s)) continue;
    const double turn_rad =
        std::remainder((cell(i + 1, 3) - cell(i, 3)) * std::numbers::pi / 180, 2 * std::numbers::pi);
    wheels.push_back({(time_s + next_s) / 2, (cell(i, 4) + cell(i, 5)) / 2, turn_rad / (next_s - time_s)});
  }
  return wheels;
}

TEST(RealRecordings, TheRealStadiumRunTurns365DegreesAndTheClocksAre6650MillisecondsApart) {
  const std::string path = test::shared_file("samples/vicon_csv/QBii_Stadium_1m_ccw.csv");
  SKIP_WITHOUT(path);
  const BodyTrack track = read_track(test::text_of_file(path), path);
  const std::string log =
      test::text_of_file(test::shared_file("samples/vicon_csv/QBii_Stadium_1m_ccw.odometry.csv"));
  const std::vector<WheelMotion> wheels = stadium_wheels(log);
  const FloorPath floor = place_on_floor(track, wheels);
  const FloorFindings& findings = floor.findings;
  ASSERT_TRUE(findings.clock.has_value());
  const double offset_s = findings.clock->offset_s - 773.95;
  std::printf(
      "  turned %.3f degrees, offset %.3f s, skew %.5f, correlation %.4f and %.4f, path %.3f m, wheels %.3f "
      "m\n",
      findings.turned_rad * 180 / std::numbers::pi, offset_s, findings.clock->skew,
      findings.clock->correlation, findings.turning_correlation, findings.path_m, findings.wheels_path_m);
  EXPECT_NEAR(findings.turned_rad * 180 / std::numbers::pi, 365.03, 0.05);
  EXPECT_NEAR(std::abs(offset_s), 6.650, 0.01);  // times of the log have two decimals
  EXPECT_GT(findings.turning_correlation, 0.998);
  EXPECT_FALSE(findings.reversed);
  EXPECT_FALSE(findings.mirrored);
  EXPECT_NEAR(findings.up[2], 1, 1e-3);
}

TEST(RealRecordings, ARealLogThatSaysCentimetresAndHoldsMetresIsNoticed) {
  const std::string path = test::shared_file("samples/vicon_csv/QBii_Stadium_1m_ccw.odometry.csv");
  SKIP_WITHOUT(path);
  const std::string log = test::text_of_file(path);
  const BodyTrack track = read_track(log, path);
  EXPECT_EQ(track.facts.length_unit, "cm");
  const FloorPath floor = place_on_floor(track, stadium_wheels(log));
  EXPECT_EQ(floor.findings.unit_ratio, 0.01);
}

/// The raw log of a robot: time, ticks of the left and the right wheel since the row before.
std::vector<WheelMotion> sousa_wheels(const std::string& text) {
  constexpr double kMetresPerTick = std::numbers::pi * 0.084 / 2796.8, kWheelbase_m = 0.2;
  std::istringstream lines(text.substr(text.rfind("\xEF\xBB\xBF", 0) == 0 ? 3 : 0));
  std::vector<WheelMotion> wheels;
  double before_s = 0;
  for (std::string line; std::getline(lines, line);) {
    double time_s = 0, left = 0, right = 0;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &time_s, &left, &right) != 3) continue;
    const double dt = time_s - before_s;
    if (!wheels.empty() || before_s > 0)
      wheels.push_back({(time_s + before_s) / 2, kMetresPerTick * (left + right) / 2 / dt,
                        kMetresPerTick * (right - left) / kWheelbase_m / dt});
    before_s = time_s;
  }
  return wheels;
}

TEST(RealRecordings, TwelveYUpTakesWithEulerAnglesMatchTheEncoders) {
  const std::string folder = test::shared_file("sousa_optiodom/square/");
  SKIP_WITHOUT(folder + "231220200029/231220200029_run-01_opti.csv.gz");
  for (const std::string session : {"231220200029", "231220200040"}) {
    for (int run = 1; run <= 6; ++run) {  // the first three clockwise
      const std::string stem = folder + session + "/" + session + "_run-0" + std::to_string(run);
      BodyTrack track = read_track(test::text_of_file(stem + "_opti.csv.gz"), "take");
      const LostSamples lost = mark_lost(track);
      const FloorPath floor = place_on_floor(track, sousa_wheels(test::text_of_file(stem + "_odo.csv")));
      const FloorFindings& findings = floor.findings;
      ASSERT_TRUE(findings.clock.has_value());
      std::printf(
          "  lost %zu + %zu + %zu, up (%.4f %.4f %.4f), %.2f degrees apart, handedness %.2f, turned %.2f "
          "degrees, "
          "skew %.4f, correlation %.4f, length ratio %.3f\n",
          lost.absent, lost.repeated, lost.filled, findings.up[0], findings.up[1], findings.up[2],
          findings.evidence.disagreement_rad * 180 / std::numbers::pi, findings.handedness,
          findings.turned_rad * 180 / std::numbers::pi, findings.clock->skew, findings.turning_correlation,
          findings.length_ratio);
      EXPECT_GT(findings.up[1], 0.999);
      EXPECT_FALSE(findings.mirrored);
      EXPECT_FALSE(findings.reversed);
      // Once round the square; the ends differ from a whole turn by what the odometry was wrong.
      EXPECT_NEAR(findings.turned_rad, (run <= 3 ? -2 : 2) * std::numbers::pi, 0.25);
      EXPECT_GT(findings.turning_correlation, 0.98);
      EXPECT_NEAR(findings.length_ratio, 1, 0.05);
      EXPECT_NEAR(findings.clock->skew, -0.0235,
                  0.001);  // the robot's clock runs 2.41 % slow: 1 / 1.0241 - 1
    }
  }
}

}  // namespace
}  // namespace astro::truth
