#include <gtest/gtest.h>

#include <fstream>

#include "tests/golden/printed.hpp"
#include "tests/golden/thesis_tables.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// Tables 11 and 12 of the thesis through the command line: every variant to the digits of the recomputation.
namespace astro {
namespace {

using golden::prints_as;

std::string write_table(const std::filesystem::path& path, const golden::Table& table) {
  std::ofstream file(path);
  file << "run,ex_mm,ey_mm,etheta_rad\n";
  for (std::size_t i = 0; i < table.size(); ++i)
    file << i + 1 << ',' << table[i].x_mm << ',' << table[i].y_mm << ',' << table[i].theta_rad << '\n';
  return path.string();
}

nlohmann::json calibrate(const std::vector<std::string>& options) {
  const test::TemporaryFolder folder;
  std::vector<std::string> arguments{
      "calibrate",   "end-poses",
      "--cw",        write_table(folder.path() / "cw.csv", golden::kTable11Cw),
      "--ccw",       write_table(folder.path() / "ccw.csv", golden::kTable12Ccw),
      "--side",      "3",
      "--wheelbase", "0.29",
      "--json"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const support::Outcome outcome = support::astrolabe(arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return support::parse_json(outcome.out);
}

struct Variant {
  std::vector<std::string> options;
  const char *alpha_deg, *beta_deg, *R_mm, *E_b, *E_d, *c_R, *c_L, *b_mm;
};

class GoldenVariant : public testing::TestWithParam<Variant> {};

TEST_P(GoldenVariant, ComesOutOfTheCommandLine) {
  const Variant& golden = GetParam();
  const nlohmann::json result = calibrate(golden.options);
  EXPECT_TRUE(prints_as(result["alpha_deg"], golden.alpha_deg));
  EXPECT_TRUE(prints_as(result["beta_deg"], golden.beta_deg));
  EXPECT_TRUE(prints_as(result["R_m"].get<double>() * 1000, golden.R_mm));
  EXPECT_TRUE(prints_as(result["E_b"], golden.E_b));
  EXPECT_TRUE(prints_as(result["E_d"], golden.E_d));
  EXPECT_TRUE(prints_as(result["c_R"], golden.c_R));
  EXPECT_TRUE(prints_as(result["c_L"], golden.c_L));
  EXPECT_TRUE(prints_as(result["b_m"].get<double>() * 1000, golden.b_mm));
}

INSTANTIATE_TEST_SUITE_P(Thesis, GoldenVariant,
                         testing::Values(Variant{{"--method", "umbmark", "--angles", "x"},
                                                 "-0.4331274",
                                                 "2.565810",
                                                 "66997.05",
                                                 "0.9952105",
                                                 "1.00433794",
                                                 "1.00216427",
                                                 "0.99783573",
                                                 "288.61105"},
                                         Variant{{"--method", "umbmark", "--angles", "y"},
                                                 "0.0204928",
                                                 "2.462363",
                                                 "69811.23",
                                                 "1.0002277",
                                                 "1.00416271",
                                                 "1.00207703",
                                                 "0.99792297",
                                                 "290.06605"},
                                         Variant{{"--method", "umbmark", "--angles", "thesis"},
                                                 "-0.4331274",
                                                 "2.462363",
                                                 "69811.23",
                                                 "0.9952105",
                                                 "1.00416271",
                                                 "1.00207703",
                                                 "0.99792297",
                                                 "288.61105"},
                                         Variant{{"--method", "umbmark", "--angles", "average"},
                                                 "-0.2063173",
                                                 "2.514086",
                                                 "68375.19",
                                                 "0.9977128",
                                                 "1.00425032",
                                                 "1.00212065",
                                                 "0.99787935",
                                                 "289.33672"},
                                         Variant{{"--method", "extended", "--formula", "published"},
                                                 "-0.1677334",
                                                 "2.334087",
                                                 "73647.31",
                                                 "1.0001053",
                                                 "1.00394587",
                                                 "1.00196905",
                                                 "0.99803095",
                                                 "290.03053"},
                                         Variant{{"--method", "extended", "--formula", "exact"},
                                                 "-0.1677334",
                                                 "2.334087",
                                                 "73642.22",
                                                 "0.9981398",
                                                 "1.00393837",
                                                 "1.00196532",
                                                 "0.99803468",
                                                 "289.46053"}));

TEST(GoldenCommandLine, LeastSquaresOfTheEndPositions) {
  const nlohmann::json result = calibrate({"--method", "least-squares"});
  EXPECT_TRUE(prints_as(result["alpha_deg"], "-0.26821"));
  EXPECT_TRUE(prints_as(result["E_b"], "0.9970287"));
  EXPECT_TRUE(prints_as(result["E_d"], "1.00427898"));
  EXPECT_TRUE(prints_as(result["c_R"], "1.00213492"));
  EXPECT_TRUE(prints_as(result["c_L"], "0.99786508"));
  EXPECT_TRUE(prints_as(result["b_m"].get<double>() * 1000, "289.13833"));
}

TEST(GoldenCommandLine, CentresOfGravity) {
  const nlohmann::json result = calibrate({});
  EXPECT_TRUE(prints_as(result["x_cg_cw_m"].get<double>() * 1000, "-223.334"));
  EXPECT_TRUE(prints_as(result["y_cg_cw_m"].get<double>() * 1000, "-260.004"));
  EXPECT_TRUE(prints_as(result["theta_cg_cw_rad"], "0.151240"));
  EXPECT_TRUE(prints_as(result["r_cg_cw_m"].get<double>() * 1000, "342.753783"));
  EXPECT_TRUE(prints_as(result["x_cg_ccw_m"].get<double>() * 1000, "314.048"));
  EXPECT_TRUE(prints_as(result["y_cg_ccw_m"].get<double>() * 1000, "-255.712"));
  EXPECT_TRUE(prints_as(result["theta_cg_ccw_rad"], "0.174660"));
  EXPECT_TRUE(prints_as(result["r_cg_ccw_m"].get<double>() * 1000, "404.987374"));
  EXPECT_TRUE(prints_as(result["E_max_syst_m"].get<double>() * 1000, "404.987374"));
  EXPECT_EQ(result["method"], "robust");
  EXPECT_GT(result["standard_errors"]["b_m"], 0);
}

TEST(EndPoses, KeepTheEThatWasLoaded) {
  const nlohmann::json without = calibrate({}), with = calibrate({"--e", "0.02"});
  EXPECT_EQ(without["e"], 0);
  EXPECT_EQ(with["e"], 0.02);
  EXPECT_EQ(with["carried"]["e"], 0.02);
  // A closed square consists of lines and spins, for which e is nothing.
  for (const char* factor : {"c_R", "c_L", "b_m"}) EXPECT_EQ(with[factor], without[factor]) << factor;
  EXPECT_EQ(support::astrolabe({"calibrate", "end-poses", "--e", "0.3"}).code, 2);
}

}  // namespace
}  // namespace astro
