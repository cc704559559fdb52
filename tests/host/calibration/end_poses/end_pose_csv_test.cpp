#include "host/calibration/end_poses/end_pose_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/host/calibration/end_poses/square_runs.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::calibration {
namespace {

using support::Tells;

using test::error_of;

Remark told(std::string_view text) {
  return support::told_by([&] { (void)read_end_poses(text, "cw.csv"); });
}

std::string refusal(std::string_view text) { return told(text).sentence; }

TEST(EndPoseCsv, ReadsTheFormOfTheThesisTables) {
  const auto runs = read_end_poses(
      "run,ex_mm,ey_mm,euclid_mm_printed,etheta_rad\n1,-271.98,-385.85,472.07,0.1874\n2,-189.93,-156.64,246."
      "19,0.1222\n",
      "cw.csv");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_DOUBLE_EQ(runs[0].x_m, -0.27198);
  EXPECT_DOUBLE_EQ(runs[0].y_m, -0.38585);
  EXPECT_DOUBLE_EQ(runs[0].theta_rad, 0.1874);
  EXPECT_DOUBLE_EQ(runs[1].x_m, -0.18993);
}

TEST(EndPoseCsv, UnitsAndOrderComeFromTheHeader) {
  const auto runs = read_end_poses("etheta_deg,ey_cm,EX_M\n90,-2.5,+0.125\n", "cw.csv");
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_DOUBLE_EQ(runs[0].x_m, 0.125);
  EXPECT_DOUBLE_EQ(runs[0].y_m, -0.025);
  EXPECT_DOUBLE_EQ(runs[0].theta_rad, std::numbers::pi / 2);
}

TEST(EndPoseCsv, AMissingHeadingIsNotMeasured) {
  EXPECT_TRUE(std::isnan(read_end_poses("ex_m,ey_m\n1,2\n", "cw.csv")[0].theta_rad));
  const auto runs = read_end_poses("ex_m,ey_m,etheta_rad\n1,2,\n3,4,0.5\n", "cw.csv");
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
    const auto runs = read_end_poses(text, "cw.csv");
    ASSERT_EQ(runs.size(), 2U) << text;
    EXPECT_DOUBLE_EQ(runs[0].x_m, -0.0015);
    EXPECT_DOUBLE_EQ(runs[0].y_m, 0.020);
    EXPECT_DOUBLE_EQ(runs[1].x_m, 0.003);
    EXPECT_DOUBLE_EQ(runs[1].y_m, 0.004);
  }
}

TEST(EndPoseCsv, AFileWithoutRunsIsRefused) {
  const std::string empty =
      "cw.csv is empty: it needs a header such as ex_mm,ey_mm,etheta_rad and a row per run";
  EXPECT_EQ(refusal(""), empty);
  EXPECT_EQ(refusal("\xEF\xBB\xBF\r\n \r\n"), empty);
  EXPECT_EQ(refusal("ex_mm,ey_mm\n"), "cw.csv has a header and no data rows: it needs one per run below it");
}

TEST(EndPoseCsv, AColumnWithoutAUnitIsRefused) {
  EXPECT_EQ(refusal("ex,ey_mm\n1,2\n"),
            "cw.csv, line 1: column ex does not say its unit, as ex_mm or ex_cm or ex_m does");
  EXPECT_EQ(refusal("ex_inch,ey_mm\n1,2\n").find("cw.csv, line 1: column ex_inch does not say its unit"), 0U);
  EXPECT_EQ(refusal("ex_mm,ey [mm]\n1,2\n").find("cw.csv, line 1: column ey [mm] does not say its unit"), 0U);
  EXPECT_EQ(refusal("ex_mm,ey_mm,etheta\n1,2,3\n"),
            "cw.csv, line 1: column etheta does not say its unit, as etheta_rad or etheta_deg does");
}

TEST(EndPoseCsv, AMissingOrDoubledColumnIsRefused) {
  EXPECT_EQ(refusal("\nrun,ey_mm\n1,2\n"), "cw.csv, line 2: there is no column ex_mm or ex_cm or ex_m");
  EXPECT_EQ(refusal("ex_mm,etheta_rad\n1,2\n"), "cw.csv, line 1: there is no column ey_mm or ey_cm or ey_m");
  EXPECT_EQ(refusal("1,2\n3,4\n"), "cw.csv, line 1: there is no column ex_mm or ex_cm or ex_m");
  EXPECT_THAT(told("ex_mm,ex_m,ey_m\n1,2,3\n"),
              Tells("cw.csv, line 1: columns ex_mm and ex_m both give ex", Help::keep_one_column));
}

TEST(EndPoseCsv, ACellThatIsNoNumberIsNamedWithLineAndColumn) {
  EXPECT_EQ(refusal("ex_mm,ey_mm\n1,2\n\n3,four\n"),
            "cw.csv, line 4: column ey_mm: \"four\" is not a number such as -12.5");
  for (const std::string cell : {"1.5mm", "0x10", "1 2", "--1", "+-1", "+", "-", "1e", "."}) {
    EXPECT_EQ(refusal("ex_mm,ey_mm\n" + cell + ",2\n"),
              "cw.csv, line 2: column ex_mm: \"" + cell + "\" is not a number such as -12.5");
  }
  EXPECT_THAT(told("ex_mm,ey_mm\n1,\n"),
              Tells("cw.csv, line 2: column ey_mm: the cell is empty", Help::fill_cell_or_leave_out));
}

TEST(EndPoseCsv, ACellThatIsNotFiniteIsRefused) {
  for (const std::string cell : {"nan", "NaN", "inf", "-inf", "Infinity", "1e999"}) {
    EXPECT_THAT(told("ex_mm,ey_mm,etheta_deg\n1,2," + cell + "\n"),
                Tells("cw.csv, line 2: column etheta_deg: \"" + cell + "\" is not a finite number",
                      Help::measure_again_or_leave_out));
  }
}

TEST(EndPoseCsv, ARowOfTheWrongWidthIsRefused) {
  EXPECT_THAT(told("ex_mm,ey_mm\n1,2\n3\n"),
              Tells("cw.csv, line 3: the row has 1 cells and the header 2", Help::fill_each_cell));
  EXPECT_THAT(told("ex_mm,ey_mm\n1,5,2,5\n"),
              Tells("cw.csv, line 2: the row has 4 cells and the header 2", Help::fill_each_cell));
}

TEST(EndPoseCsv, WhatIsNoCommaSeparatedTextIsRefused) {
  EXPECT_THAT(told("ex_mm;ey_mm\n1,5;2,5\n"),
              Tells("cw.csv, line 1: the cells are separated by semicolons", Help::separate_by_commas));
  EXPECT_EQ(refusal("ex_mm,ey_mm\n\"1,2\n"), "cw.csv, line 2: a quote is opened and not closed on its line");
  using namespace std::string_view_literals;
  EXPECT_THAT(told("\xFF\xFE"
                   "e\0x\0"sv),
              Tells(testing::HasSubstr("cw.csv is not plain text: byte "), Help::save_as_csv));
}

TEST(EndPoseCsv, AFileThatMixesDirectionsIsRefusedWhereOneIsWanted) {
  EXPECT_THAT(
      told("ex_m,ey_m,direction\n1,2,cw\n1,2,CW\n1,2,ccw\n"),
      Tells("cw.csv, line 4: column direction: the file mixes cw and ccw runs where one direction is wanted",
            Help::split_by_direction));
}

TEST(EndPoseCsv, ADirectionThatIsNoneIsRefused) {
  EXPECT_EQ(refusal("direction,x_err_m,y_err_m\nleft,1,2\n"),
            "cw.csv, line 2: column direction: \"left\" is not a direction, which is cw or ccw");
}

TEST(EndPoseCsv, ATapeMeasureTableIsRead) {
  const auto runs = read_end_poses(
      "run,direction,x_err_m,y_err_m,heading_err_deg\n1,cw,-0.2,-0.3,9\n2,CW,-0.1,-0.2,\n", "tape.csv");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_DOUBLE_EQ(runs[0].theta_rad, std::numbers::pi / 20);
  EXPECT_DOUBLE_EQ(runs[1].y_m, -0.2);
  EXPECT_TRUE(std::isnan(runs[1].theta_rad));
  EXPECT_EQ(refusal("direction,x_err,y_err_m\ncw,1,2\n"),
            "cw.csv, line 1: column x_err does not say its unit, as ex_mm or ex_cm or ex_m does");
}

}  // namespace
}  // namespace astro::calibration
