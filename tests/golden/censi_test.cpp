#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "host/calibration/preparation/relative_pose.hpp"
#include "tests/support/base/places.hpp"

// The closed form against the answers that its authors published for a Khepera III with a laser scanner.
namespace astro::golden {
namespace {

using calibration::RelativePose;
using nlohmann::json;

std::filesystem::path file_of(const std::string& name) {
  return support::shared_data() / "censi_khepera" / name;
}

std::vector<RelativePose> pieces_of(const std::string& subset) {
  std::ifstream lines(file_of(subset + ".tuple"));
  std::vector<RelativePose> pieces;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    const json tuple = json::parse(line);
    const double duration_s = tuple["T"];
    const json& laser = tuple["sm"];
    pieces.push_back(
        {{{duration_s * tuple["phi_l"].get<double>(), duration_s * tuple["phi_r"].get<double>()}},
         {laser[0], laser[1], laser[2]}});
  }
  return pieces;
}

class Censi : public testing::TestWithParam<const char*> {};

TEST_P(Censi, PublishedAnswersComeOut) {
  const std::string subset = GetParam();
  if (!std::filesystem::exists(file_of(subset + ".tuple")))
    GTEST_SKIP() << "not at hand: " << file_of(subset + ".tuple");
  const json published = json::parse(std::ifstream(file_of(subset + "_results.json")));
  // As the authors ran it: four rounds without the worst hundredth.
  const auto fit = calibration::fit_relative_poses_trimmed(pieces_of(subset), 4, 0.01);
  ASSERT_TRUE(fit);
  const auto expect_same = [&](const char* name, double value) {
    const double answer = published[name];
    // Six digits were printed: half of the last one, and 1e-6 where that is finer.
    const double printed = 0.5 * std::pow(10, std::floor(std::log10(std::abs(answer))) - 5);
    EXPECT_NEAR(value, answer, std::max(1.05 * printed, 1e-6 * std::abs(answer))) << name;
  };
  expect_same("axle", fit->b_m);
  expect_same("l_diam", 2 * fit->r_left);
  expect_same("r_diam", 2 * fit->r_right);
  expect_same("l_x", fit->sensor.x_m);
  expect_same("l_y", fit->sensor.y_m);
  expect_same("l_theta", fit->sensor.theta_rad);
}

INSTANTIATE_TEST_SUITE_P(Khepera, Censi, testing::Values("l90_0", "l90_1", "l90_2"));

}  // namespace
}  // namespace astro::golden
