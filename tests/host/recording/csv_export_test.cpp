#include "host/recording/csv_export.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "host/base/files.hpp"
#include "tests/host/recording/support.hpp"

namespace astro::recording {
namespace {

std::string text_of(const std::filesystem::path& path) { return std::string(as_text(load_file(path))); }

TEST(CsvExport, TablesHaveTheirUnitsInTheHeaderAndEmptyCellsWhereTruthIsLost) {
  const support::TempFolder folder;
  constexpr double kNotSeen = std::numeric_limits<double>::quiet_NaN();
  recording::Run run;
  run.odometry = {{1'500'000, 0.1, -2, 1e-20, 0.5, 0, -7, 8}};
  run.truth = {{1, 1, 2, 3, true}, {2'000'002, 9, 9, 9, false}, {3'000'000, 1, 2, kNotSeen, true}};
  export_csv(run, folder / "csv");
  EXPECT_EQ(text_of(folder / "csv/odometry.csv"),
            "__time,/odom/x_m,/odom/y_m,/odom/theta_rad,/odom/v_mps,/odom/omega_radps,/odom/left_counts,"
            "/odom/right_counts\n1.500000,0.1,-2,1e-20,0.5,0,-7,8\n");
  EXPECT_EQ(text_of(folder / "csv/truth.csv"),
            "__time,/truth/x_m,/truth/y_m,/truth/theta_rad,/truth/valid\n"
            "0.000001,1,2,3,1\n2.000002,,,,0\n3.000000,1,2,,1\n");
}

}  // namespace
}  // namespace astro::recording
