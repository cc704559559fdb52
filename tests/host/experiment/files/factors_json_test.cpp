#include "host/experiment/files/factors_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace astro::experiment {
namespace {

TEST(FactorsJson, ReadsBackWhatItWrote) {
  const nlohmann::json json = to_json(calibration::WheelFactors{1.001, 0.999, 0.29, -0.02, 0.2});
  EXPECT_EQ(json["e"], -0.02);
  EXPECT_EQ(to_json(factors_in(json)), json);
}

TEST(FactorsJson, WithoutACurvatureEffectIsAnOlderVersions) {
  const calibration::WheelFactors factors = factors_in({{"c_R", 1.001}, {"c_L", 0.999}, {"b_m", 0.29}});
  EXPECT_EQ(factors.e, 0);
  EXPECT_EQ(factors.kappa0, calibration::kUsualKappa0);
}

TEST(FactorsJson, WithoutAFactorIsRefused) {
  EXPECT_THROW(factors_in({{"c_R", 1.001}, {"c_L", 0.999}}), nlohmann::json::exception);
}

}  // namespace
}  // namespace astro::experiment
