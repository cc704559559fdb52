#include "host/import/wheels/wheel_csv.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include "host/base/error.hpp"
#include "host/formats/tables/rows.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/places.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::importing {
namespace {

using astro::support::measured;
using astro::support::Taken;
using astro::support::Tells;
using astro::support::told_by;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

WheelTrack wheels(std::string_view text, const WheelTable& table = {}) {
  return wheels_in_table(text, "w.csv", table);
}

Remark why(std::string_view text, const WheelTable& table = {}) {
  return told_by([&] { wheels(text, table); });
}

TEST(WheelCsv, TheHeaderTellsUnitsAndOrder) {
  const WheelTrack counts = wheels("time_s,left_counts,right_counts\n0,1,2\n0.05,3,5\n");
  EXPECT_EQ(counts.unit, WheelUnit::counts);
  EXPECT_THAT(counts.samples, ElementsAre(WheelSample{0, 1, 2}, WheelSample{50'000'000, 3, 5}));
  const WheelTrack degrees =
      wheels("Right wheel [deg];note;Left wheel [deg];Stamp (ms)\n180;x;-90;5\n360;;0;6\n");
  EXPECT_EQ(degrees.unit, WheelUnit::radians);
  ASSERT_EQ(degrees.samples.size(), 2U);
  EXPECT_EQ(degrees.samples[0].time_ns, 5'000'000);
  EXPECT_DOUBLE_EQ(degrees.samples[0].left, -std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(degrees.samples[0].right, std::numbers::pi);
  const WheelTrack metres =
      wheels("\xEF\xBB\xBFt_ns\tL_mm\tR_mm\r\n7\t1000\t2000\r\n\r\n# note\r\n8\t+1e3\t2500\r\n");
  EXPECT_EQ(metres.unit, WheelUnit::metres);
  EXPECT_THAT(metres.samples, ElementsAre(WheelSample{7, 1, 2}, WheelSample{8, 1, 2.5}));
}

TEST(WheelCsv, ATableWithoutAHeaderIsDescribedFromOutside) {
  const WheelTable table{"time_s,-,left_ticks,right_ticks", false};
  EXPECT_THAT(wheels("1 x 2 3\n2   x 4 5 \n", table).samples,
              ElementsAre(WheelSample{1'000'000'000, 2, 3}, WheelSample{2'000'000'000, 4, 5}));
  EXPECT_THAT(wheels("a,b,c,d\n1,x,2,3\n2,x,4,5\n", table).samples.size(), 2U) << "the header is passed over";
}

/// Both wheels at an even pace from these counts.
std::string paced(int left, int right, int first, int count) {
  std::string rows;
  for (int i = first; i < first + count; ++i)
    rows += fmt::format("{:.2f},{},{}\n", 0.02 * i, left + 60 * (i - first), right + 50 * (i - first));
  return rows;
}

/// A log of travel per interval, 20 rows a second, of a robot that stands, drives and stands. Some rows are lost, or the logger
/// was late and the row after holds the travel of both.
std::string interval_log(const std::vector<int>& missing, bool held_back) {
  std::string text = "time_s,left_counts,right_counts\n";
  int owed = 0;
  for (int row = 0; row < 200; ++row) {
    const int travel = row < 30 || row >= 170 ? 0 : 20 + row % 3;
    if (std::find(missing.begin(), missing.end(), row) != missing.end()) {
      owed += held_back ? travel : 0;
      continue;
    }
    text += fmt::format("{:.2f},{},{}\n", 0.05 * row, travel + owed, travel + owed);
    owed = 0;
  }
  return text;
}

TEST(WheelCsv, TravelPerIntervalOfWhichRowsAreLostIsRefused) {
  const WheelTable intervals{"", true};
  EXPECT_THAT(why(interval_log({60, 90, 91, 140}, false), intervals),
              Tells(WheelTableProblem::rows_lost, "w.csv", "3", "3.050", "2.9"));
  EXPECT_NO_THROW(wheels(interval_log({60, 90, 91, 140}, true), intervals)) << "the logger was late";
  EXPECT_NO_THROW(wheels(interval_log({5, 6, 180}, false), intervals)) << "the robot stood";
  EXPECT_NO_THROW(wheels(interval_log({60, 90, 91, 140}, false))) << "counters lose nothing";
}

TEST(WheelCsv, TravelPerIntervalIsSummed) {
  const auto expected = ElementsAre(WheelSample{1, 1, 2}, WheelSample{2, 4, 2}, WheelSample{3, 2, 9});
  EXPECT_THAT(wheels("time_ns,delta_left_counts,delta_right_counts\n1,1,2\n2,3,0\n3,-2,7\n").samples,
              expected);
  EXPECT_THAT(
      wheels("time_ns,left_counts_per_interval,right_counts_per_interval\n1,1,2\n2,3,0\n3,-2,7\n").samples,
      expected);
  EXPECT_THAT(wheels("time_ns,left_counts,right_counts\n1,1,2\n2,3,0\n3,-2,7\n", {"", true}).samples,
              expected);
  EXPECT_THAT(why("time_ns,delta_left_counts,delta_right_counts\n1,1,2\n2,,0\n3,-2,7\n"),
              Tells(WheelTableProblem::cell_empty, "w.csv", "3"));
}

TEST(WheelCsv, TimesOfTheEpochAreExactToANanosecond) {
  EXPECT_THAT(wheels("stamp_s,left_m,right_m\n1700000000.123456789,0,0\n1700000000.123456790,0,0\n").samples,
              ElementsAre(WheelSample{1700000000123456789, 0, 0}, WheelSample{1700000000123456790, 0, 0}));
}

TEST(WheelCsv, CountersAndAnglesThatStartAgainAreMadeContinuous) {
  const WheelTrack wide = wheels("time_ns,left_counts,right_counts\n1,65000,100\n2,200,65500\n3,900,65000\n");
  EXPECT_THAT(wide.samples, ElementsAre(WheelSample{1, 65000, 100}, WheelSample{2, 65736, -36},
                                        WheelSample{3, 66436, -536}));
  EXPECT_EQ(wide.remarks.size(), 2U);
  const WheelTrack full = wheels("time_ns,left_counts,right_counts\n1,2147483000,5\n2,-2147483000,9\n");
  EXPECT_THAT(full.samples, ElementsAre(WheelSample{1, 2147483000, 5}, WheelSample{2, 2147484296, 9}));
  const WheelTrack turns = wheels("time_ns,left_rad,right_rad\n1,3.0,0\n2,-3.0,50\n");
  EXPECT_NEAR(turns.samples[1].left, 2 * std::numbers::pi - 3.0, 1e-12);
  EXPECT_EQ(turns.samples[1].right, 50);
}

TEST(WheelCsv, AResetWhileDrivingIsJoinedAtTheWheelsPace) {
  const std::string head = "time_s,left_counts,right_counts\n";
  // Also of a few hundred counts, which are less than a metre of most robots.
  for (const int begin : {40'000, 700}) {
    const WheelTrack track =
        wheels(head + paced(begin, 900, 0, 40) + paced(0, 0, 40, 40) + paced(5, 7, 80, 40));
    EXPECT_EQ(track.samples.back().left - track.samples.front().left, 60 * 119);
    EXPECT_EQ(track.samples.back().right - track.samples.front().right, 50 * 119);
    EXPECT_THAT(track.remarks, ElementsAre(Tells(WheelRemark::restart_joined, "w.csv", "0.800"),
                                           Tells(WheelRemark::restart_joined, "w.csv", "1.600")));
  }
}

TEST(WheelCsv, AResetBeforeTheLastSampleIsJoinedAtThePaceBeforeIt) {
  const WheelTrack track =
      wheels("time_s,left_counts,right_counts\n" + paced(40'000, 900, 0, 40) + paced(0, 0, 40, 1));
  EXPECT_EQ(track.samples.back().left - track.samples.front().left, 60 * 40);
}

TEST(WheelCsv, CountsStayWholeWhereAResetIsJoined) {
  // The step over the reset is the mean of 10 before it and 11 behind it.
  std::string rows = "time_s,left_counts,right_counts\n";
  for (int i = 0; i < 80; ++i) {
    const int counts = i < 40 ? 50'001 + 10 * i : 11 * (i - 40);
    rows += std::to_string(0.02 * i) + "," + std::to_string(counts) + "," + std::to_string(counts) + "\n";
  }
  const WheelTrack track = wheels(rows);
  EXPECT_THAT(track.remarks, ElementsAre(Tells(WheelRemark::restart_joined, "w.csv", "0.800")));
  for (const WheelSample& sample : track.samples) EXPECT_EQ(sample.left, std::round(sample.left));
}

TEST(WheelCsv, AResetAfterWhichSamplesAreMissingIsNoWrapAndIsNotJoined) {
  const std::string rows = "time_s,left_counts,right_counts\n" + paced(40'000, 100, 0, 40);
  EXPECT_THAT(why(rows + paced(0, 0, 100, 40)), Tells(CounterProblem::begins_again, "w.csv", "2.000"));
  EXPECT_THAT(why(rows + paced(0, 2'100, 40, 40)),
              Tells(CounterProblem::starts_again, "w.csv", "left", "42340", "0", "0.800000"))
      << "one counter alone";
  // Eight seconds of messages are lost, and in this time the left wheel passes the end of its range.
  const WheelTrack gap = wheels(rows + "8.8,844,10000\n");
  EXPECT_EQ(gap.samples.back().left, 65536 + 844);
  EXPECT_EQ(gap.remarks.size(), 1U);
}

TEST(WheelCsv, AFirstSampleOfZerosBeforeTheCountersWereReadIsLeftOut) {
  const WheelTrack track =
      wheels("time_s,left_counts,right_counts\n-0.02,0,0\n" + paced(51'234, 49'888, 0, 40));
  EXPECT_EQ(track.samples.front().left, 51'234);
  EXPECT_THAT(track.remarks, ElementsAre(Tells(WheelRemark::first_left_out, "w.csv")));
}

TEST(WheelCsv, ACounterThatOnlyCountsFarDoesNotWrap) {
  const WheelTrack far = wheels("time_ns,left_counts,right_counts\n1,0,0\n2,20000,70000\n3,40000,140000\n");
  EXPECT_THAT(far.samples,
              ElementsAre(WheelSample{1, 0, 0}, WheelSample{2, 20000, 70000}, WheelSample{3, 40000, 140000}));
  EXPECT_TRUE(far.remarks.empty());
}

TEST(WheelCsv, WhatIsUnclearIsRefusedWithItsColumns) {
  EXPECT_THAT(
      why("Time (s),x (cm),left velocity (),right velocity ()\n0,0,0,0\n"),
      Tells(WheelProblem::columns_unclear, "Time (s)", "x (cm)", "left velocity ()", "right velocity ()"));
  EXPECT_THAT(why("time_s,left_m,right_rad\n0,0,0\n"),
              Tells(WheelProblem::columns_unclear, "time_s", "left_m", "right_rad"));
  EXPECT_THAT(why("time_s,left_m,left_m,right_m\n0,0,0,0\n"),
              Tells(WheelProblem::columns_unclear, "time_s", "left_m", "left_m", "right_m"));
  EXPECT_THAT(why("0,0,0\n1,1,1\n"), Tells(WheelProblem::columns_unclear, "0", "0", "0"));
}

TEST(WheelCsv, BadCellsAreNamedWithLineAndColumn) {
  const std::string head = "time_s,left_counts,right_counts\n0,0,0\n";
  EXPECT_THAT(why(head + "1,x,2\n"), Tells(WheelTableProblem::not_a_number, "w.csv", "3", "2", "x"));
  EXPECT_THAT(why(head + "1,2,nan\n"), Tells(WheelTableProblem::not_a_number, "w.csv", "3", "3", "nan"));
  EXPECT_THAT(why(head + "soon,2,1\n"), Tells(WheelTableProblem::not_a_time, "w.csv", "3", "1", "soon"));
  EXPECT_THAT(why(head + "-1,2,1\n"), Tells(WheelTableProblem::times_fall, "w.csv", "3"));
  EXPECT_THAT(why(head), Tells(WheelTableProblem::too_few_rows, "w.csv", "2"));
  EXPECT_THAT(why(std::string("a\0b\n", 4)), Tells(tables::TextProblem::not_plain_text, "w.csv", "2"));
}

TEST(WheelCsv, TwoRecordingsInOneTableAreRefusedAtTheSecond) {
  std::string text = "time_s,left_counts,right_counts\n";
  for (int i = 0; i < 200; ++i) text += fmt::format("{:.2f},{},{}\n", 0.05 * (i % 100), i, i);
  EXPECT_THAT(why(text), Tells(WheelTableProblem::times_fall, "w.csv", "102"));
}

TEST(WheelCsv, TimesThatFallBehindAHundredOtherFallsAreRefused) {
  std::string text = "time_s,left_counts,right_counts\n";
  for (int i = 0; i < 6000; ++i) {
    const double late_s = i == 5990 ? 0.3 : 0.2 * (i / 50);
    text += fmt::format("{:.2f},{},{}\n", 0.02 * i - late_s, i, i);
  }
  EXPECT_THAT(why(text), Tells(WheelTableProblem::times_fall, "w.csv", "52"));
}

TEST(WheelCsv, RowsWithEmptyCellsAndRepeatedTimesAreCounted) {
  const WheelTrack track = wheels("time_s,left_counts,right_counts\n0,0,0\n1,,1\n2,2,2\n2,3,3\n3,4,4\n");
  EXPECT_EQ(track.samples.size(), 3U);
  EXPECT_THAT(track.remarks, ElementsAre(Tells(WheelTableProblem::times_repeated, "w.csv", "1"),
                                         Tells(WheelTableProblem::rows_incomplete, "w.csv", "1")));
}

TEST(WheelCsv, RowsOfTimesWithTooFewDigitsAreSpreadEvenlyOrRefused) {
  std::string even = "time_s,left_counts,right_counts\n", twice = even, uneven = even;
  for (int row = 0; row < 500; ++row) {
    const std::string counts = fmt::format("{},{}\n", 20 * row, 21 * row);
    even += fmt::format("{},{}", row / 50, counts);
    uneven += fmt::format("{},{}", row < 300 ? row / 50 : row / 10, counts);
    twice += fmt::format("{:.2f},{}{:.2f},{}", 0.02 * row, counts, 0.02 * row, counts);
  }
  const WheelTrack track = wheels(even);
  ASSERT_EQ(track.samples.size(), 500U);
  for (std::size_t i = 0; i < 500; ++i)
    EXPECT_EQ(track.samples[i].time_ns, 10'000'000 + 20'000'000 * static_cast<std::int64_t>(i));
  EXPECT_THAT(track.remarks, ElementsAre(Tells(WheelTableProblem::times_spread, "w.csv", "50", "1")));
  EXPECT_THAT(why(uneven), Tells(WheelTableProblem::times_too_coarse, "w.csv", testing::_));
  const WheelTrack once = wheels(twice);
  EXPECT_EQ(once.samples.size(), 500U) << "copies lose nothing";
  EXPECT_THAT(once.remarks, ElementsAre(Tells(WheelTableProblem::times_repeated, "w.csv", "500")));
}

TEST(WheelCsv, NamesInAnyStyleAreUnderstood) {
  const auto counts = ElementsAre(WheelSample{0, 1, 2}, WheelSample{20'000'000, 3, 5});
  for (const char* text :
       {"timeMs,encoderLeft,encoderRight\n0,1,2\n20,3,5\n", "millis;leftTicks;rightTicks\n0;1;2\n20;3;5\n",
        "t\tencL\tencR\ns\tticks\tticks\n0\t1\t2\n0.02\t3\t5\n",
        "# time left_encoder right_encoder\n0.00 1 2\n0.02 3 5\n",
        "stamp.sec,stamp.nanosec,l_enc,r_enc\n0,0,1,2\n0,20000000,3,5\n",
        "time_s,ml_left_ticks,mr_left_torque,ml_right_ticks,mr_right_torque\n0,1,9,2,9\n0.02,3,9,5,9\n",
        "t_s,mr_left_ticks,mr_right_ticks\n0,1,2\n0.02,3,5\n", "Zeit (s);links;rechts\n0,00;1;2\n0,02;3;5\n",
        "temps_s,gauche,droite\n0,1,2\n0.02,3,5\n", "tiempo_s,izquierda,derecha\n0,1,2\n0.02,3,5\n",
        "tempo_s,ruota sinistra,ruota destra\n0,1,2\n0.02,3,5\n",
        "timestamp,left,right\n1970-01-01T00:00:00Z,1,2\n1970-01-01T00:00:00.020Z,3,5\n",
        "Time [s],Left wheel (counts),Right wheel (counts),left_cmd,right_cmd\n0,1,2,9,9\n0.02,3,5,9,9\n"}) {
    const WheelTrack track = wheels(text);
    EXPECT_EQ(track.unit, WheelUnit::counts) << text;
    EXPECT_THAT(track.samples, counts) << text;
  }
}

TEST(WheelCsv, DifferencesThatAreNamedWithALetterAreTravelPerIntervalIfTheyEndAsTheyBegin) {
  const WheelTrack travel = wheels("time_s,d_left,d_right\n0,0,0\n1,50,40\n2,50,40\n3,1,0\n");
  EXPECT_THAT(travel.samples.back(), (WheelSample{3'000'000'000, 101, 80}));
  EXPECT_THAT(travel.remarks, Contains(Tells(WheelRemark::per_interval_assumed, "d_left")));
  EXPECT_THAT(wheels("time_s,dL,dR\n0,0,0\n1,50,40\n2,100,80\n3,101,80\n").samples.back(),
              (WheelSample{3'000'000'000, 101, 80}))
      << "distances go on";
  EXPECT_THAT(wheels("time_s,left,right,d_left,d_right\n0,7,7,0,0\n1,9,8,2,1\n2,9,8,0,0\n").samples.back(),
              (WheelSample{2'000'000'000, 9, 8}));
}

TEST(WheelCsv, ADistanceThatComesBackToItsStartIsNoTravelPerInterval) {
  for (const bool per_row : {false, true}) {
    std::string text = "time_s,d_left_m,d_right_m\n";
    double left = 0, right = 0;
    for (int i = 0; i <= 400; ++i) {
      const double forth = std::clamp((180 - std::abs(i - 200)) / 180.0, 0.0, 1.0);
      const auto counts = [&](double way_m) { return std::round(way_m * forth / 3e-4) * 3e-4; };
      const double l = counts(2), r = counts(2.1);
      text +=
          fmt::format("{:.2f},{:.6f},{:.6f}\n", 0.02 * i, per_row ? l - left : l, per_row ? r - right : r);
      left = l;
      right = r;
    }
    const WheelTrack track = wheels(text);
    EXPECT_NEAR(track.samples[200].left, 2, 0.01) << per_row;  // of two metres forth and back
    EXPECT_EQ(track.remarks.empty(), !per_row);
  }
}

TEST(WheelCsv, AUnitMayStandInFrontOfTheSide) {
  const WheelTrack track = wheels("t_s,rpm_left,rpm_right\n0,60,60\n1,60,60\n");
  EXPECT_NEAR(track.samples.back().left, 2 * std::numbers::pi, 1e-12);
  EXPECT_EQ(track.columns.values, "rpm");
  EXPECT_EQ(wheels("t_s,rad_s_l,rad_s_r\n0,1,1\n1,1,1\n").columns.values, "rad/s");
  EXPECT_EQ(wheels("t_s,mm_left,mm_right\n0,1,1\n1,2,2\n").samples.back().left, 0.002);
  EXPECT_EQ(wheels("t_s,m_left,m_right\n0,1,1\n1,2,2\n").unit, WheelUnit::counts) << "m is a motor there";
}

TEST(WheelCsv, ARemarkAboutSeveralWheelsIsMadeOnce) {
  const auto remarks =
      wheels("Zeit(s) FL(rad/s) FR(rad/s) RL(rad/s) RR(rad/s)\n0 1 1 1 1\n1 1 1 1 1\n2 1 1 1 1\n").remarks;
  EXPECT_EQ(std::ranges::count(remarks, Kind(WheelRemark::speeds_integrated), &Remark::kind), 1);
}

TEST(WheelCsv, DatesMayStandBelowANameWithAUnit) {
  EXPECT_THAT(
      wheels("time_s,left_counts,right_counts\n2024-05-01T10:00:00Z,1,2\n2024-05-01T10:00:00.5Z,3,5\n")
          .samples.back()
          .time_ns,
      1'714'557'600'500'000'000);
}

TEST(WheelCsv, WhatANameDoesNotSayIsSaidOrAskedFor) {
  EXPECT_THAT(
      wheels("timestamp,left,right\n0,1,2\n20,3,5\n40,5,8\n").remarks,
      ElementsAre(Tells(WheelRemark::counts_assumed, "left"), Tells(WheelRemark::time_unit_assumed, "ms")));
  for (const char* text :
       {"time_s,left_pos,right_pos\n0,1.5,2\n1,3,5\n", "time_s,left_vel,right_vel\n0,1,2\n1,3,5\n",
        "time_s,left_counts\n0,1\n1,2\n", "left_counts,right_counts\n0,1\n1,2\n"}) {
    const Remark told = why(text);
    EXPECT_EQ(told.kind, Kind(WheelProblem::columns_unclear)) << text;
  }
  EXPECT_THAT(wheels("stamp,encA,encB\n0,1,2\n20,3,5\n",
                     {.columns = "stamp=time_ms,encA=right_counts,encB=left_counts"})
                  .samples,
              ElementsAre(WheelSample{0, 2, 1}, WheelSample{20'000'000, 5, 3}));
  EXPECT_THAT(why("time,left_counts,right_counts\n0,1,2\n0,3,5\n"),
              Tells(WheelTableProblem::time_unit_unknown, "w.csv", "1"));
}

TEST(WheelCsv, CumulativeTravelIsTakenBeforeTravelPerInterval) {
  EXPECT_EQ(wheels("time_s,delta_left_rad,delta_right_rad,left_m,right_m\n0,9,9,1,2\n1,9,9,3,4\n").unit,
            WheelUnit::radians);
  EXPECT_EQ(wheels("time_s,delta_left_ticks,delta_right_ticks,left_rad,right_rad\n0,9,9,1,2\n1,9,9,3,4\n")
                .samples.back()
                .left,
            18)
      << "counts before angles";
}

TEST(WheelCsv, TheColumnsOfTheTableAreListedWhereSomeWereStated) {
  EXPECT_THAT(why("stamp,encA,encB\n0,1,2\n20,3,5\n", {.columns = "stamp=time_ms,encA=left_counts"}),
              Tells(WheelProblem::columns_unclear, "stamp", "encA", "encB"));
}

TEST(WheelCsv, TravelIsTakenBeforeSpeedsAndCountsBeforeAngles) {
  const WheelTrack track = wheels(
      "time_s,left_rad_s,right_rad_s,left_rad,right_rad,left_ticks,right_ticks\n0,9,9,8,8,1,2\n1,9,9,8,8,3,"
      "4\n");
  EXPECT_EQ(track.unit, WheelUnit::counts);
  EXPECT_THAT(track.samples, ElementsAre(WheelSample{0, 1, 2}, WheelSample{1'000'000'000, 3, 4}));
}

// A wheel whose speed is a sine: the integral is known, and the trapezoids' error is of the size that the remark states.
TEST(WheelCsv, SpeedsAreIntegratedWithTheErrorThatTheirSamplingLeaves) {
  for (const auto& [unit, per_unit] : {std::pair{"rad_s", 1.0}, std::pair{"rpm", 60 / (2 * std::numbers::pi)},
                                       std::pair{"deg_s", 180 / std::numbers::pi}}) {
    std::string text = fmt::format("time_s,left_{0},right_{0}\n", unit);
    double error_of_half = 0;
    for (int i = 0; i <= 300; ++i) {
      const double t = 0.1 * i, speed = 5 + 4 * std::sin(2 * t);
      text += fmt::format("{:.3f},{:.9f},{:.9f}\n", t, per_unit * speed, -per_unit * speed);
    }
    const WheelTrack track = wheels(text);
    EXPECT_EQ(track.unit, WheelUnit::radians);
    const double truth = 5 * 30 + 2 * (1 - std::cos(60.0));
    error_of_half = std::abs(track.samples.back().left - truth);
    EXPECT_LT(error_of_half, 0.02) << unit;
    EXPECT_NEAR(track.samples.back().right, -track.samples.back().left, 1e-9);
    ASSERT_EQ(track.remarks.size(), 1U);
    EXPECT_EQ(track.remarks[0].kind, Kind(WheelRemark::speeds_integrated));
    EXPECT_LT(std::stod(track.remarks[0].values.at(0)), 0.1) << "of the path, in percent";
  }
  EXPECT_EQ(wheels("time_s,left_mps,right_mps\n0,1,1\n1,1,1\n2,1,1\n").unit, WheelUnit::metres);
}

TEST(WheelCsv, OfFourWheelsTheMeansOfTheSidesAreTaken) {
  const WheelTrack track = wheels("time_s,FL,FR,RL,RR\n0,0,0,0,0\n1,100,200,102,200\n2,200,400,204,400\n");
  EXPECT_THAT(track.samples, ElementsAre(WheelSample{0, 0, 0}, WheelSample{1'000'000'000, 101, 200},
                                         WheelSample{2'000'000'000, 202, 400}));
  EXPECT_THAT(track.remarks, testing::Contains(Tells(WheelRemark::sides_differ, "left", "2")));
  EXPECT_THAT(track.remarks, testing::Contains(Tells(WheelRemark::sides_differ, "right", "0")));
  EXPECT_EQ(
      wheels("time_s,front_left_rad,front_right_rad,rear_left_rad,rear_right_rad\n0,0,0,0,0\n1,1,2,3,4\n")
          .samples[1]
          .left,
      2);
}

/// A wheel that goes `range` counts round and round, and the other the other way.
std::string counting(double range, double offset, int rows, int step) {
  std::string text = "time_s,left_counts,right_counts\n";
  for (int i = 0; i < rows; ++i) {
    const auto at = [&](double value) { return value - range * std::floor(value / range) + offset; };
    text += fmt::format("{:.2f},{},{}\n", 0.02 * i, at(step * i), at(range / 2 - (step - 1) * i));
  }
  return text;
}

TEST(WheelCsv, CountersOfAnyRangeAreMadeContinuous) {
  for (const double range : {256.0, 4096.0, 9000.0, 65536.0, 360.0, 16777216.0})
    for (const double offset : {0.0, -range / 2}) {
      if (offset != 0 && (range == 9000 || range == 360))
        continue;  // with a sign only powers of two are known
      const int step = static_cast<int>(range / 90), rows = 400;
      const WheelTrack track = wheels(counting(range, offset, rows, step));
      EXPECT_EQ(track.samples.back().left - track.samples.front().left, step * (rows - 1))
          << range << ' ' << offset;
      EXPECT_EQ(track.samples.back().right - track.samples.front().right, -(step - 1) * (rows - 1)) << range;
      EXPECT_EQ(track.remarks.size(), 2U) << range;
    }
}

/// A log of a drive with stops, lines and spins at a pace of `part` of the range from row to row, with the travel of both wheels.
struct WrappingLog {
  std::string text = "time_s,left_counts,right_counts\n";
  double left = 0, right = 0;

  WrappingLog(double range, double part, std::mt19937& random) {
    const double rows = 60 + static_cast<double>(random() % 400);
    const double start_left = static_cast<double>(random() % static_cast<unsigned>(range)),
                 start_right = static_cast<double>(random() % static_cast<unsigned>(range));
    double at_left = start_left, at_right = start_right, v_left = 0, v_right = 0, to_left = 0, to_right = 0;
    std::uint64_t hold = 0;
    for (int row = 0; row < rows; ++row) {
      if (hold-- == 0) {
        hold = 10 + random() % 40;
        const auto motion = random() % 5;  // a stop, a spin either way, or a line
        to_left = motion == 0 ? 0 : motion == 1 ? -0.5 : motion == 2 ? 0.5 : 1;
        to_right = motion == 0 ? 0 : motion < 3 ? -to_left : 1;
      }
      v_left += std::clamp(to_left - v_left, -0.2, 0.2);
      v_right += std::clamp(to_right - v_right, -0.2, 0.2);
      at_left += v_left * part * range;
      at_right += v_right * part * range;
      const auto around = [&](double count) { return std::floor(count) - range * std::floor(count / range); };
      text += fmt::format("{:.2f},{},{}\n", 0.1 * row, around(at_left), around(at_right));
      if (row == 0) left = -std::floor(at_left), right = -std::floor(at_right);
    }
    left += std::floor(at_left);
    right += std::floor(at_right);
  }
};

// Of counters that are passed only once or twice not every one shows its range; of those that come round within two rows none
// shows its direction. Then the table is refused by its counter, and hardly any is read wrongly.
TEST(WheelCsv, CountersOfAnyRangeAtAnyPaceAreMadeContinuousOrRefused) {
  constexpr unsigned kSeed = 20240701;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  for (const auto& [least, most, share] : {std::tuple{0.003, 0.44, 0.97}, std::tuple{0.6, 1.2, 0.0}}) {
    int right = 0, wrong = 0;
    constexpr int kLogs = 1000;
    for (int round = 0; round < kLogs; ++round) {
      constexpr std::array kRanges{256.0, 360.0, 1000.0, 1024.0, 3600.0, 4096.0, 9000.0, 16384.0, 65536.0};
      const double range = kRanges[random() % kRanges.size()];
      std::uniform_real_distribution<double> logarithm(std::log(least), std::log(most));
      const WrappingLog log(range, std::exp(logarithm(random)), random);
      try {
        const std::vector<WheelSample> samples = wheels(log.text).samples;
        const double miss = std::max(std::abs(samples.back().left - samples.front().left - log.left),
                                     std::abs(samples.back().right - samples.front().right - log.right));
        ++(miss < range / 4 ? right : wrong);  // resets that are joined are so to a few counts
      } catch (const Error& error) {
        EXPECT_THAT((std::array{Kind(CounterProblem::range_unknown), Kind(CounterProblem::starts_again),
                                Kind(CounterProblem::too_fast)}),
                    testing::Contains(error.kind()))
            << error.what();
      }
    }
    EXPECT_LE(wrong, 3) << least;
    EXPECT_GE(right, share * kLogs) << least;
    std::printf("%.3g to %.3g of the range: %d right, %d wrong of %d\n", least, most, right, wrong, kLogs);
  }
}

TEST(WheelCsv, SingleWrongCountsAreNoRange) {
  std::string rows = "time_s,left_counts,right_counts\n" + paced(100'000, 200'000, 0, 100);
  for (const char* wrong : {"0.40,101200,", "1.20,103600,"}) {
    const std::size_t at = rows.find(wrong) + 5;
    rows.replace(at, 6, "900000");
  }
  EXPECT_THAT(wheels(rows).remarks, ElementsAre())
      << "leaps are refused where the size of the wheels is known";
}

TEST(WheelCsv, ARangeThatTheDataDoNotShowIsAskedFor) {
  const std::string odd = counting(7'919, 0, 400, 88);
  EXPECT_EQ(why(odd).kind, Kind(CounterProblem::range_unknown));
  const WheelTrack track = wheels(odd, {.counter_range = 7'919});
  EXPECT_EQ(track.samples.back().left, 88 * 399);
  EXPECT_THAT(why(odd, {.counter_range = 5'000}),
              Tells(CounterProblem::beyond_range, "w.csv", "left", testing::_, "5000"));
}

TEST(WheelCsv, HugeTablesStayInBounds) {
  constexpr std::size_t kSize = std::size_t{8} << 20;
  for (const std::string& text :
       {support::filled("1,2,3\n", kSize), support::filled(",", kSize), support::filled("\n", kSize),
        "time_ns,left_m,right_m\n" + support::filled("1,2,3\n", kSize)}) {
    const Taken taken = measured([&] { wheels(text); });
    EXPECT_BOUNDED(taken, text.size());
  }
}

TEST(WheelCsv, RandomDamageNeverHarmsTheReader) {
  constexpr unsigned kSeed = 20240615;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  const std::string seed = "time_s,left_counts,right_counts\n0.5,1,2\n0.75,3e2,-4\n1.25,+5,6.5\n";
  constexpr std::string_view kMarks = ",;\t\n\r.-+e09\"# \xFF\0x";
  int read = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bad = seed;
    for (std::size_t edits = 1 + random() % 4; edits > 0; --edits)
      bad[random() % bad.size()] = kMarks[random() % kMarks.size()];
    try {
      const WheelTrack track = wheels(bad);
      ++read;
      for (std::size_t i = 1; i < track.samples.size(); ++i)
        EXPECT_GT(track.samples[i].time_ns, track.samples[i - 1].time_ns) << bad;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("w.csv"));
    }
  }
  EXPECT_GT(read, 100);
}

// The raw log of a public data set: no header, a byte order mark, ticks per interval of 50 ms.
TEST(WheelCsv, ARawLogOfARealRobotReads) {
  const std::filesystem::path path =
      astro::support::shared_data() / "sousa_optiodom/circular/231220200121/231220200121_run-06_odo.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no sample " << path;
  const Bytes text = tables::text_of_file(path);
  const WheelTrack track =
      wheels_in_table(as_text(text), path.string(), {"time_s,left_counts,right_counts", true});
  ASSERT_GT(track.samples.size(), 100U);
  EXPECT_EQ(track.samples[0], (WheelSample{3'489'700'000'000, 0, 0}));
  EXPECT_EQ(track.samples[3], (WheelSample{3'489'850'000'000, 133, 173}));
}

}  // namespace
}  // namespace astro::importing
