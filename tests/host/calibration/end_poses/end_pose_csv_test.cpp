#include "host/calibration/end_poses/end_pose_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/host/calibration/end_poses/square_runs.hpp"

namespace astro::calibration {
namespace {

using test::error_of;

std::string refusal(std::string_view text) {
  return error_of([&] { (void)read_end_poses(text, "cw.csv"); });
}

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
  EXPECT_EQ(refusal("ex_mm,ey_mm\n"), "cw.csv has a header and no data rows: write one row per run below it");
}

TEST(EndPoseCsv, AColumnWithoutAUnitIsRefused) {
  EXPECT_EQ(refusal("ex,ey_mm\n1,2\n"),
            "cw.csv, line 1: column ex does not say its unit: name it ex_mm or ex_cm or ex_m");
  EXPECT_EQ(refusal("ex_inch,ey_mm\n1,2\n").find("cw.csv, line 1: column ex_inch does not say its unit"), 0U);
  EXPECT_EQ(refusal("ex_mm,ey [mm]\n1,2\n").find("cw.csv, line 1: column ey [mm] does not say its unit"), 0U);
  EXPECT_EQ(refusal("ex_mm,ey_mm,etheta\n1,2,3\n"),
            "cw.csv, line 1: column etheta does not say its unit: name it etheta_rad or etheta_deg");
}

TEST(EndPoseCsv, AMissingOrDoubledColumnIsRefused) {
  EXPECT_EQ(refusal("\nrun,ey_mm\n1,2\n"), "cw.csv, line 2: there is no column ex_mm or ex_cm or ex_m");
  EXPECT_EQ(refusal("ex_mm,etheta_rad\n1,2\n"), "cw.csv, line 1: there is no column ey_mm or ey_cm or ey_m");
  EXPECT_EQ(refusal("1,2\n3,4\n"), "cw.csv, line 1: there is no column ex_mm or ex_cm or ex_m");
  EXPECT_EQ(refusal("ex_mm,ex_m,ey_m\n1,2,3\n"),
            "cw.csv, line 1: columns ex_mm and ex_m both give ex: keep one of them");
}

TEST(EndPoseCsv, ACellThatIsNoNumberIsNamedWithLineAndColumn) {
  EXPECT_EQ(refusal("ex_mm,ey_mm\n1,2\n\n3,four\n"),
            "cw.csv, line 4: column ey_mm: \"four\" is not a number: write it like -12.5");
  for (const std::string cell : {"1.5mm", "0x10", "1 2", "--1", "+-1", "+", "-", "1e", "."}) {
    EXPECT_EQ(refusal("ex_mm,ey_mm\n" + cell + ",2\n"),
              "cw.csv, line 2: column ex_mm: \"" + cell + "\" is not a number: write it like -12.5");
  }
  EXPECT_EQ(refusal("ex_mm,ey_mm\n1,\n"),
            "cw.csv, line 2: column ey_mm: the cell is empty: write the number or leave the run out");
}

TEST(EndPoseCsv, ACellThatIsNotFiniteIsRefused) {
  for (const std::string cell : {"nan", "NaN", "inf", "-inf", "Infinity", "1e999"}) {
    EXPECT_EQ(refusal("ex_mm,ey_mm,etheta_deg\n1,2," + cell + "\n"),
              "cw.csv, line 2: column etheta_deg: \"" + cell +
                  "\" is not a finite number: measure again or leave the run out");
  }
}

TEST(EndPoseCsv, ARowOfTheWrongWidthIsRefused) {
  const std::string remedy = ": give every column a cell, and write numbers with a decimal point";
  EXPECT_EQ(refusal("ex_mm,ey_mm\n1,2\n3\n"),
            "cw.csv, line 3: the row has 1 cells and the header 2" + remedy);
  EXPECT_EQ(refusal("ex_mm,ey_mm\n1,5,2,5\n"),
            "cw.csv, line 2: the row has 4 cells and the header 2" + remedy);
}

TEST(EndPoseCsv, WhatIsNoCommaSeparatedTextIsRefused) {
  EXPECT_EQ(
      refusal("ex_mm;ey_mm\n1,5;2,5\n"),
      "cw.csv, line 1: the cells are separated by semicolons: use commas, and decimal points in the numbers");
  EXPECT_EQ(refusal("ex_mm,ey_mm\n\"1,2\n"), "cw.csv, line 2: a quote is opened and not closed on its line");
  using namespace std::string_view_literals;
  EXPECT_EQ(refusal("\xFF\xFE"
                    "e\0x\0"sv),
            "cw.csv is not plain text: save the table as comma separated UTF-8");
}

TEST(EndPoseCsv, AFileThatMixesDirectionsIsRefusedWhereOneIsWanted) {
  EXPECT_EQ(refusal("ex_m,ey_m,direction\n1,2,cw\n1,2,CW\n1,2,ccw\n"),
            "cw.csv, line 4: column direction: the file mixes cw and ccw runs where one direction is wanted: "
            "split it");
}

TEST(EndPoseCsv, ADirectionThatIsNoneIsRefused) {
  EXPECT_EQ(refusal("direction,x_err_m,y_err_m\nleft,1,2\n"),
            "cw.csv, line 2: column direction: \"left\" is not a direction: write cw or ccw");
}

TEST(EndPoseCsv, ATapeMeasureTableIsRead) {
  const auto runs = read_end_poses(
      "run,direction,x_err_m,y_err_m,heading_err_deg\n1,cw,-0.2,-0.3,9\n2,CW,-0.1,-0.2,\n", "tape.csv");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_DOUBLE_EQ(runs[0].theta_rad, std::numbers::pi / 20);
  EXPECT_DOUBLE_EQ(runs[1].y_m, -0.2);
  EXPECT_TRUE(std::isnan(runs[1].theta_rad));
  EXPECT_EQ(refusal("direction,x_err,y_err_m\ncw,1,2\n"),
            "cw.csv, line 1: column x_err does not say its unit: name it ex_mm or ex_cm or ex_m");
}

}  // namespace
}  // namespace astro::calibration
