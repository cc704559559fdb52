#include "host/base/text/csv_table.hpp"

#include <gmock/gmock.h>

#include <string>

#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"

// Implausible tables are refused with the line number, without holding the whole table in memory.
namespace astro {
namespace {

template <class Line>
void expect_refused(const std::string& text, CsvProblem problem, Line line) {
  const support::Taken taken = support::measured([&] {
    EXPECT_THAT([&] { split_csv(text, "t.csv"); }, support::ThrowsTelling(problem, "t.csv", line));
  });
  EXPECT_BOUNDED(taken, text.size());
}

TEST(CsvTable, RefusesALineOfFiftyMegabytesOfCommas) {
  expect_refused(std::string(50'000'000, ','), CsvProblem::too_many_columns, "1");
  expect_refused("x_m,y_m\n" + std::string(50'000'000, ','), CsvProblem::too_many_columns, "2");
}

TEST(CsvTable, RefusesMoreShortRowsThanItCanHold) {
  const auto later_line = testing::Not(testing::AnyOf("1", "2"));
  expect_refused("x,y\n" + support::filled("0,0\n", 50'000'000), CsvProblem::too_many_cells, later_line);
  expect_refused(std::string(998, ',') + "x\n" + support::filled(std::string(998, ',') + "1\n", 50'000'000),
                 CsvProblem::too_many_cells, later_line);
}

TEST(CsvTable, TakesATruthFileOfAnHour) {
  const std::string text =
      "time_s,x_m,y_m,theta_rad\n" + support::filled("1234.567,1.2345,-0.4321,0.0123\n", 12'000'000);
  const support::Taken taken =
      support::measured([&] { EXPECT_GT(split_csv(text, "t.csv").rows.size(), 100U * 3600); });
  EXPECT_EQ(taken.complaint, "");
  EXPECT_TRUE(taken.ended);
}

}  // namespace
}  // namespace astro
