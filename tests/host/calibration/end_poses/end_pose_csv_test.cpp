#include "host/calibration/end_poses/end_pose_csv.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "host/formats/tables/table.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::calibration {
namespace {

using Problem = EndPoseTableProblem;
using support::Tells;

Remark told(std::string_view text, std::optional<Sense> sense = {}) {
  return support::told_by([&] { (void)read_end_poses(text, "cw.csv", sense); });
}

std::vector<EndPose> poses_in(std::string_view text) { return read_end_poses(text, "cw.csv").poses; }

TEST(EndPoseCsv, ReadsTheFormOfTheThesisTables) {
  const auto runs = poses_in(
      "run,ex_mm,ey_mm,euclid_mm_printed,etheta_rad\n1,-271.98,-385.85,472.07,0.1874\n2,-189.93,-156.64,246."
      "19,0.1222\n");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_DOUBLE_EQ(runs[0].x_m, -0.27198);
  EXPECT_DOUBLE_EQ(runs[0].y_m, -0.38585);
  EXPECT_DOUBLE_EQ(runs[0].theta_rad, 0.1874);
  EXPECT_DOUBLE_EQ(runs[1].x_m, -0.18993);
}

TEST(EndPoseCsv, UnitsAndOrderComeFromTheHeader) {
  const auto runs = poses_in("etheta_deg,ey_cm,EX_M\n90,-2.5,+0.125\n");
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_DOUBLE_EQ(runs[0].x_m, 0.125);
  EXPECT_DOUBLE_EQ(runs[0].y_m, -0.025);
  EXPECT_DOUBLE_EQ(runs[0].theta_rad, std::numbers::pi / 2);
}

TEST(EndPoseCsv, AMissingHeadingIsNotMeasured) {
  EXPECT_TRUE(std::isnan(poses_in("ex_m,ey_m\n1,2\n")[0].theta_rad));
  const auto runs = poses_in("ex_m,ey_m,etheta_rad\n1,2,\n3,4,0.5\n");
  EXPECT_TRUE(std::isnan(runs[0].theta_rad));
  EXPECT_EQ(runs[1].theta_rad, 0.5);
}

TEST(EndPoseCsv, SpreadsheetHabitsDoNotMatter) {
  const std::string plain = "ex_mm,ey_mm,note\n-1.5,2e1,a\n3,4,b\n";
  for (const std::string& text : {
           "\xEF\xBB\xBF" + plain,
           std::string("ex_mm,ey_mm,note\r\n-1.5,2e1,a\r\n3,4,b\r\n"),
           std::string("ex_mm,ey_mm,note\r-1.5,2e1,a\r3,4,b\r"),
           std::string("\n\n ex_mm ,\tey_mm, note\n\n -1.5 , 2e1,a\n  \n,,\n3,4,b\n\n"),
           std::string("\"ex_mm\",\"ey_mm\",\"note\"\n\"-1.5\",\" 2e1 \",\"a, \"\"b\"\"\"\n\"3\",\"4\",b"),
       }) {
    const auto runs = poses_in(text);
    ASSERT_EQ(runs.size(), 2U) << text;
    EXPECT_DOUBLE_EQ(runs[0].x_m, -0.0015);
    EXPECT_DOUBLE_EQ(runs[0].y_m, 0.020);
    EXPECT_DOUBLE_EQ(runs[1].x_m, 0.003);
    EXPECT_DOUBLE_EQ(runs[1].y_m, 0.004);
  }
}

TEST(EndPoseCsv, AFileWithoutRunsIsRefused) {
  EXPECT_THAT(told(""), Tells(tables::TextProblem::empty, "cw.csv"));
  EXPECT_THAT(told("\xEF\xBB\xBF\r\n \r\n"), Tells(tables::TextProblem::empty, "cw.csv"));
  EXPECT_THAT(told("ex_mm,ey_mm\n"), Tells(Problem::no_rows, "cw.csv"));
}

TEST(EndPoseCsv, AColumnWithoutAUnitIsRefused) {
  EXPECT_THAT(told("ex,ey_mm\n1,2\n"), Tells(Problem::no_unit, "cw.csv", "1", "ex"));
  EXPECT_THAT(told("ex_furlong,ey_mm\n1,2\n"), Tells(Problem::no_unit, "cw.csv", "1", "ex_furlong"));
  EXPECT_THAT(told("ex_mm,ey [furlong]\n1,2\n"), Tells(Problem::no_unit, "cw.csv", "1", "ey [furlong]"));
  EXPECT_THAT(told("ex_rad,ey_mm\n1,2\n"), Tells(Problem::no_unit, "cw.csv", "1", "ex_rad"));
  EXPECT_THAT(told("ex_mm,ey_mm,etheta\n1,2,3\n"), Tells(Problem::no_unit, "cw.csv", "1", "etheta"));
}

TEST(EndPoseCsv, AHeadingWithAnUnusualNameIsNotDropped) {
  for (const std::string title : {"etheta_grad", "etheta_mrad", "etheta_deg_meas", "etheta in deg",
                                  "heading_err_deg_meas", "theta_deg", "e_theta", "yaw_err_deg", "dphi_rad"})
    EXPECT_THAT(told("ex_mm,ey_mm," + title + "\n1,2,3\n"), Tells(Problem::no_unit, "cw.csv", "1", title));
  EXPECT_EQ(poses_in("ex_mm,ey_mm,etheta_rad,etheta_rad_printed\n1,2,3,4\n")[0].theta_rad, 3);
}

TEST(EndPoseCsv, AMissingOrDoubledColumnIsRefused) {
  EXPECT_THAT(told("\nrun,ey_mm\n1,2\n"), Tells(Problem::no_column, "cw.csv", "2", "ex"));
  EXPECT_THAT(told("ex_mm,etheta_rad\n1,2\n"), Tells(Problem::no_column, "cw.csv", "1", "ey"));
  EXPECT_THAT(told("1,2\n3,4\n"), Tells(Problem::no_column, "cw.csv", "1", "ex"));
  EXPECT_THAT(told("ex_mm,ex_m,ey_m\n1,2,3\n"), Tells(Problem::two_columns, "cw.csv", "1", "ex_mm", "ex_m"));
}

TEST(EndPoseCsv, ACellThatIsNoNumberIsNamedWithLineAndColumn) {
  EXPECT_THAT(told("ex_mm,ey_mm\n1,2\n\n3,four\n"),
              Tells(Problem::not_a_number, "cw.csv", "4", "ey_mm", "four"));
  for (const std::string cell : {"1.5mm", "0x10", "1 2", "--1", "+-1", "+", "-", "1e", "."}) {
    EXPECT_THAT(told("ex_mm,ey_mm\n" + cell + ",2\n3,4\n"),
                Tells(Problem::not_a_number, "cw.csv", "2", "ex_mm", cell));
  }
  EXPECT_THAT(told("ex_mm,ey_mm\n1,\n"), Tells(Problem::empty_cell, "cw.csv", "2", "ey_mm"));
}

TEST(EndPoseCsv, ACellThatIsNotFiniteIsRefused) {
  for (const std::string cell : {"nan", "NaN", "inf", "-inf", "Infinity", "1e999"}) {
    EXPECT_THAT(told("ex_mm,ey_mm,etheta_deg\n1,2," + cell + "\n"),
                Tells(Problem::not_a_number, "cw.csv", "2", "etheta_deg", cell));
  }
}

TEST(EndPoseCsv, ARowOfTheWrongWidthIsRefused) {
  EXPECT_THAT(told("ex_mm,ey_mm\n1,2\n3\n"), Tells(Problem::empty_cell, "cw.csv", "3", "ey_mm"));
  for (const char* rows : {"1,5,2,5\n", "1,2\n3,4\n1,5,2,5\n"})
    EXPECT_THAT(told(std::string("ex_mm,ey_mm\n") + rows),
                Tells(tables::TableProblem::rows_of_other_length, "cw.csv", testing::_, "4", "2"));
}

TEST(EndPoseCsv, WhateverSeparatesTheCellsAndMarksTheFractionsIsRead) {
  for (const std::string text :
       {"ex_mm;ey_mm;etheta_deg\n-1,5;2,25;0,5\n", "sep=;\nex_mm;ey_mm;etheta_deg\n-1,5;2,25;0,5\n",
        "ex_mm\tey_mm\tetheta_deg\n-1.5\t2.25\t0.5\n",
        "x error [mm],y error [mm],heading error [deg]\n-1.5,2.25,0.5\n",
        "# measured with a tape\nrun by;direction;note;floor;ex [mm];ey [mm];etheta "
        "[deg]\nme;cw;-;wet;-1,5;2,25;0,5\n"}) {
    const auto runs = poses_in(text);
    ASSERT_EQ(runs.size(), 1U) << text;
    EXPECT_DOUBLE_EQ(runs[0].x_m, -0.0015) << text;
    EXPECT_DOUBLE_EQ(runs[0].y_m, 0.00225) << text;
    EXPECT_DOUBLE_EQ(runs[0].theta_rad, std::numbers::pi / 360) << text;
  }
}

TEST(EndPoseCsv, AFileThatIsNoTextOrNoTableOfRunsStaysInBounds) {
  using namespace std::string_view_literals;
  EXPECT_THAT(told("\xFF\xFE"
                   "e\0x\0"sv),
              Tells(tables::TextProblem::not_plain_text, "cw.csv", "4"));
  constexpr std::size_t kSize = std::size_t{8} << 20;
  for (const std::string& text : {std::string(kSize, ','), "ex_m,ey_m\n" + std::string(kSize, ','),
                                  "ex_m,ey_m\n" + support::filled("0,0\n", kSize)}) {
    const support::Taken taken = support::measured([&] { EXPECT_NE(told(text).sentence, ""); });
    EXPECT_BOUNDED(taken, text.size());
  }
}

TEST(EndPoseCsv, AFileThatMixesDirectionsIsRefusedWhereOneIsWanted) {
  EXPECT_THAT(told("ex_m,ey_m,direction\n1,2,cw\n1,2,CW\n1,2,ccw\n"),
              Tells(Problem::both_directions, "cw.csv", "4"));
}

TEST(EndPoseCsv, ATableOfTheOtherDirectionIsRefused) {
  const std::string text = "ex_m,ey_m,direction\n\n1,2,CCW\n1,2,ccw\n";
  EXPECT_THAT(told(text, Sense::cw), Tells(Problem::other_direction, "cw.csv", "3", "CCW"));
  EXPECT_EQ(read_end_poses(text, "ccw.csv", Sense::ccw).lines, (std::vector<int>{3, 4}));
}

TEST(EndPoseCsv, ADirectionThatIsNoneIsRefused) {
  EXPECT_THAT(told("direction,x_err_m,y_err_m\nleft,1,2\n"),
              Tells(Problem::no_direction, "cw.csv", "2", "left"));
}

TEST(EndPoseCsv, ATapeMeasureTableIsRead) {
  const auto runs =
      poses_in("run,direction,x_err_m,y_err_m,heading_err_deg\n1,cw,-0.2,-0.3,9\n2,CW,-0.1,-0.2,\n");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_DOUBLE_EQ(runs[0].theta_rad, std::numbers::pi / 20);
  EXPECT_DOUBLE_EQ(runs[1].y_m, -0.2);
  EXPECT_TRUE(std::isnan(runs[1].theta_rad));
  EXPECT_THAT(told("direction,x_err,y_err_m\ncw,1,2\n"), Tells(Problem::no_unit, "cw.csv", "1", "x_err"));
}

}  // namespace
}  // namespace astro::calibration
