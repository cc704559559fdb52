#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "host/calibration/motion/clock_step.hpp"
#include "host/calibration/motion/stamp_leap.hpp"
#include "tests/golden/optiodom.hpp"
#include "tests/support/base/places.hpp"

// No clock was set in these recordings of real robots, so none may be taken for set.
namespace astro::golden {
namespace {

using namespace calibration;

class UnsetClocks : public testing::Test {
 protected:
  void look_at(const Trajectory& run, double wheelbase_m) {
    const ClockFit clock = search_clock(run, wheelbase_m, {});
    const auto step = find_clock_step(run, clock, wheelbase_m);
    const auto by_motion = step ? find_leap(run, *step, clock) : std::nullopt;
    const auto by_stamps = find_leap_without_way(run, wheelbase_m);
    EXPECT_FALSE(step && (step->sure || by_motion)) << run.name << ": " << step->by_s << " s";
    EXPECT_FALSE(by_stamps) << run.name << ": " << by_stamps->by_s << " s";
    ++drives_;
  }
  void TearDown() override { std::printf("looked at %d drives\n", drives_); }

  int drives_ = 0;
};

TEST_F(UnsetClocks, OfARobotUnderCameras) {
  if (optiodom_folder().empty()) GTEST_SKIP() << "not at hand: sousa_optiodom";
  for (const char* set : {"231220200029", "231220200040"})
    for (int run = 1; run <= 6; ++run) {
      look_at(raw_optiodom_run(set, run), kOptiodomWheelbase_m);
      look_at(synchronised_optiodom_run(set, run), kOptiodomWheelbase_m);
    }
  for (int run = 1; run <= 6; ++run)
    look_at(circular_optiodom_run("231220200121", run), kOptiodomWheelbase_m);
}

TEST_F(UnsetClocks, OfARobotWithALaserScanner) {
  constexpr double kWheelbase_m = 0.09, kRadius_m = 0.021;
  for (const char* subset : {"l90_0", "l90_1", "l90_2"}) {
    const auto path = support::shared_data() / "censi_khepera" / (std::string(subset) + ".tuple");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "not at hand: " << path;
    Trajectory run{subset, {{}}, {{0, 0, 0, 0}}};
    Pose2 pose;
    std::ifstream lines(path);
    for (std::string line; std::getline(lines, line);) {
      if (line.empty()) continue;
      const nlohmann::json tuple = nlohmann::json::parse(line);
      const double duration_s = tuple["T"];
      WheelSample wheels = run.wheels.back();
      wheels.time_s += duration_s;
      wheels.left_m += kRadius_m * duration_s * tuple["phi_l"].get<double>();
      wheels.right_m += kRadius_m * duration_s * tuple["phi_r"].get<double>();
      run.wheels.push_back(wheels);
      pose = pose * Pose2{tuple["sm"][0], tuple["sm"][1], tuple["sm"][2]};
      run.truth.push_back({wheels.time_s, pose.x_m, pose.y_m, pose.theta_rad});
    }
    // In pieces of some two minutes, as drives are.
    constexpr std::size_t kPiece = 150;
    for (std::size_t from = 0; from + kPiece <= run.wheels.size(); from += kPiece) {
      Trajectory piece{run.name + " from " + std::to_string(from), {}, {}};
      const auto at = static_cast<std::ptrdiff_t>(from), to = at + std::ptrdiff_t{kPiece};
      piece.wheels.assign(run.wheels.begin() + at, run.wheels.begin() + to);
      piece.truth.assign(run.truth.begin() + at, run.truth.begin() + to);
      look_at(piece, kWheelbase_m);
    }
  }
}

}  // namespace
}  // namespace astro::golden
