#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "host/calibration/end_poses/end_pose_csv.hpp"
#include "host/calibration/end_poses/umbmark.hpp"
#include "tests/golden/printed.hpp"
#include "tests/golden/thesis_tables.hpp"
#include "tests/support/base/places.hpp"

// What the thesis's own tables give, to every digit printed in a recomputation of them: from the embedded
// values and from the CSV files of the tables through the reader, where these files are at hand.
namespace astro::golden {
namespace {

using calibration::AngleSource;
using calibration::EndPose;
using calibration::Formula;
using calibration::Method;
using calibration::Options;

struct TableCase {
  const char* name;
  const char* file;
  const Table* rows;
  const char *rms_x_mm, *rms_y_mm, *rms_r_mm, *rms_theta_rad, *r_cg_mm;
};

const std::vector<TableCase> kTables{
    {"11 CW before", "T11_cw_uncal.csv", &kTable11Cw, "229.985", "276.090", "359.331", "0.153924", "342.754"},
    {"12 CCW before", "T12_ccw_uncal.csv", &kTable12Ccw, "318.471", "257.764", "409.714", "0.175899",
     "404.987"},
    {"13 CW UMBmark", "T13_cw_umb.csv", &kTable13CwUmbmark, "60.3911", "32.1376", "68.4098", "0.022407",
     "44.0920"},
    {"14 CCW UMBmark", "T14_ccw_umb.csv", &kTable14CcwUmbmark, "72.5255", "64.2399", "96.8851", "0.045922",
     "89.9576"},
    {"15 CW extended", "T15_cw_ext.csv", &kTable15CwExtended, "93.6299", "74.2328", "119.487", "0.038582",
     "28.4891"},
    {"16 CCW extended", "T16_ccw_ext.csv", &kTable16CcwExtended, "55.1410", "47.2979", "72.6472", "0.021354",
     "37.4484"},
};

/// Row `i` of kTables: embedded, or through the CSV reader; nothing where the file is not at hand.
std::optional<std::vector<EndPose>> load(std::size_t i, bool from_file) {
  if (!from_file) return end_poses(*kTables[i].rows);
  const std::string path = support::shared_data() / "thesis_tables" / kTables[i].file;
  if (!std::filesystem::exists(path)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return calibration::read_end_poses(text, path).poses;
}

struct VariantCase {
  const char* name;
  Options options;
  const char *alpha_deg, *beta_deg, *radius_mm, *E_b, *E_d, *c_r, *c_l, *b_mm, *alpha_Ed_deg;
};

const std::vector<VariantCase> kVariants{
    {"x only",
     {Method::umbmark, AngleSource::x},
     "-0.4331274",
     "2.565810",
     "66997.05",
     "0.9952105",
     "1.00433794",
     "1.00216427",
     "0.99783573",
     "288.61105",
     "0.0000000"},
    {"y only",
     {Method::umbmark, AngleSource::y},
     "0.0204928",
     "2.462363",
     "69811.23",
     "1.0002277",
     "1.00416271",
     "1.00207703",
     "0.99792297",
     "290.06605",
     "0.0000000"},
    {"alpha from x, beta from y",
     {Method::umbmark, AngleSource::thesis},
     "-0.4331274",
     "2.462363",
     "69811.23",
     "0.9952105",
     "1.00416271",
     "1.00207703",
     "0.99792297",
     "288.61105",
     "0.0000000"},
    {"average",
     {Method::umbmark, AngleSource::average},
     "-0.2063173",
     "2.514086",
     "68375.19",
     "0.9977128",
     "1.00425032",
     "1.00212065",
     "0.99787935",
     "289.33672",
     "0.0000000"},
    {"extended, as published",
     {Method::extended, AngleSource::average, Formula::published},
     "-0.1677334",
     "2.334087",
     "73647.31",
     "1.0001053",
     "1.00394587",
     "1.00196905",
     "0.99803095",
     "290.03053",
     "0.1772081"},
    {"extended, exact",
     {Method::extended, AngleSource::average, Formula::exact},
     "-0.1677334",
     "2.334087",
     "73642.22",
     "0.9981398",
     "1.00393837",
     "1.00196532",
     "0.99803468",
     "289.46053",
     "0.0000000"},
    {"least squares on the end positions",
     {Method::least_squares},
     "-0.26821",
     nullptr,
     nullptr,
     "0.9970287",
     "1.00427898",
     "1.00213492",
     "0.99786508",
     "289.13833",
     "0.0000000"},
};

constexpr double kDegree = std::numbers::pi / 180;

/// The parameter: false for the embedded tables, true for the files.
class ThesisTables : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    for (std::size_t i = 0; i < kTables.size(); ++i) {
      const auto table = load(i, GetParam());
      if (!table)
        GTEST_SKIP() << "not at hand: " << support::shared_data() / "thesis_tables" / kTables[i].file;
      tables_.push_back(*table);
    }
  }

  std::vector<std::vector<EndPose>> tables_;
};

TEST_P(ThesisTables, SummariesPrintTheThesisFigures) {
  for (std::size_t i = 0; i < kTables.size(); ++i) {
    SCOPED_TRACE(kTables[i].name);
    const auto s = calibration::summarize(tables_[i]);
    EXPECT_EQ(s.runs, 5);
    EXPECT_TRUE(prints_as(s.rms_x_m * 1000, kTables[i].rms_x_mm));
    EXPECT_TRUE(prints_as(s.rms_y_m * 1000, kTables[i].rms_y_mm));
    EXPECT_TRUE(prints_as(s.rms_r_m * 1000, kTables[i].rms_r_mm));
    EXPECT_TRUE(prints_as(s.rms_theta_rad, kTables[i].rms_theta_rad));
    EXPECT_TRUE(prints_as(s.r_cg_m * 1000, kTables[i].r_cg_mm));
  }
}

TEST_P(ThesisTables, CentresOfGravityBeforeCalibration) {
  const auto s = calibration::summarize(tables_[0], tables_[1]);
  EXPECT_TRUE(prints_as(s.cw.x_cg_m * 1000, "-223.334"));
  EXPECT_TRUE(prints_as(s.cw.y_cg_m * 1000, "-260.004"));
  EXPECT_TRUE(prints_as(s.cw.theta_cg_rad, "0.151240"));
  EXPECT_TRUE(prints_as(s.cw.r_cg_m * 1000, "342.753783"));
  EXPECT_TRUE(prints_as(s.ccw.x_cg_m * 1000, "314.048"));
  EXPECT_TRUE(prints_as(s.ccw.y_cg_m * 1000, "-255.712"));
  EXPECT_TRUE(prints_as(s.ccw.theta_cg_rad, "0.174660"));
  EXPECT_TRUE(prints_as(s.ccw.r_cg_m * 1000, "404.987374"));
}

TEST_P(ThesisTables, MaximumSystematicErrorFallsAsMeasured) {
  const double before_m = calibration::summarize(tables_[0], tables_[1]).E_max_syst_m;
  const double umbmark_m = calibration::summarize(tables_[2], tables_[3]).E_max_syst_m;
  const double extended_m = calibration::summarize(tables_[4], tables_[5]).E_max_syst_m;
  EXPECT_TRUE(prints_as(before_m * 1000, "404.987374"));
  EXPECT_TRUE(prints_as(umbmark_m * 1000, "89.958"));
  EXPECT_TRUE(prints_as(extended_m * 1000, "37.448"));
  EXPECT_TRUE(prints_as(before_m / umbmark_m, "4.50"));
  EXPECT_TRUE(prints_as(before_m / extended_m, "10.8"));
}

TEST_P(ThesisTables, StandardErrorsOfTheCentresSpan18To58Millimetres) {
  double least_m = 1, most_m = 0;
  for (const auto& table : tables_) {
    const double se_m = calibration::summarize(table).se_r_m;
    least_m = std::min(least_m, se_m);
    most_m = std::max(most_m, se_m);
  }
  EXPECT_TRUE(prints_as(least_m * 1000, "18"));
  EXPECT_TRUE(prints_as(most_m * 1000, "58"));
}

TEST_P(ThesisTables, EveryVariantPrintsItsFactors) {
  for (const VariantCase& v : kVariants) {
    SCOPED_TRACE(v.name);
    const auto e = calibration::estimate_factors(tables_[0], tables_[1], kSide_m, {1, 1, kNominalWheelbase_m},
                                                 v.options);
    EXPECT_TRUE(prints_as(e.alpha_rad / kDegree, v.alpha_deg));
    if (v.beta_deg) {
      EXPECT_TRUE(prints_as(e.beta_rad / kDegree, v.beta_deg));
    }
    if (v.radius_mm) {
      EXPECT_TRUE(prints_as(e.radius_m * 1000, v.radius_mm));
    }
    EXPECT_TRUE(prints_as(e.alpha_Ed_rad / kDegree, v.alpha_Ed_deg));
    EXPECT_TRUE(prints_as(e.E_b, v.E_b));
    EXPECT_TRUE(prints_as(e.E_d, v.E_d));
    EXPECT_TRUE(prints_as(e.factors.c_r, v.c_r));
    EXPECT_TRUE(prints_as(e.factors.c_l, v.c_l));
    EXPECT_TRUE(prints_as(e.factors.b_m * 1000, v.b_mm));
  }
}

INSTANTIATE_TEST_SUITE_P(Source, ThesisTables, testing::Bool(),
                         [](const auto& source) { return source.param ? "FromCsvFiles" : "Embedded"; });

TEST(PrintedDigits, HelperTellsTheLastDigitApart) {
  EXPECT_TRUE(prints_as(1.00433794, "1.0043379"));
  EXPECT_TRUE(prints_as(-0.43312744, "-0.4331274"));
  EXPECT_FALSE(prints_as(1.00433796, "1.0043379"));
  EXPECT_FALSE(prints_as(18.6, "18"));
  EXPECT_FALSE(prints_as(std::nan(""), "18"));
}

}  // namespace
}  // namespace astro::golden
