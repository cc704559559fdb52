#include "host/calibration/end_poses/misfit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>

#include "host/calibration/end_poses/compose.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "tests/host/calibration/end_poses/slipping_squares.hpp"
#include "tests/support/base/thorough.hpp"

namespace astro::calibration {
namespace {

using namespace test;

const SquareSetup kSquare{kSide_m, kNominal};

std::optional<Remark> misfit_in(const Runs& runs, const SquareSetup& setup = kSquare) {
  return misfit_of(runs.cw, runs.ccw, setup);
}

void without_headings(Runs& runs) {
  for (std::vector<EndPose>* ends : {&runs.cw, &runs.ccw})
    for (EndPose& end : *ends) end.theta_rad = kNotMeasured;
}

TEST(Misfits, AreHardlyEverFoundInHonestRuns) {
  const int experiments = support::how_often(75, 300);
  std::mt19937_64 random(12);
  int of_any = 0;
  std::normal_distribution<double> normal;
  for (const double slip : {1.0, 6.0})
    for (const int each : {1, 2, 3, 5}) {
      SlippingRobot robot(13, {.slip_m = slip * EndNoise{}.slip_m});
      int explained = 0, all = 0;
      for (int i = 0; i < experiments; ++i) {
        const double E_d = 1 + 0.006 * normal(random), E_b = 1 + 0.01 * normal(random);
        Runs runs = robot.squares(each, kNominal, compose(kNominal, E_d, E_b));
        if (i % 2 == 1) without_headings(runs);
        const auto misfit = misfit_in(runs);
        all += misfit ? 1 : 0;
        explained += misfit && misfit->kind != Kind(EndPoseProblem::misfit) ? 1 : 0;
      }
      std::printf(
          "%d squares each way, %.0f times the usual slip: %d of %d honest experiments have a misfit\n", each,
          slip, all, experiments);
      EXPECT_EQ(explained, 0);
      EXPECT_LE(all, 2);
      of_any += all;
    }
  // One in a hundred of 300 would be three in each line, and six in all lines of 75 each time.
  EXPECT_LT(of_any, 8 * experiments / 100);
}

/// What may be wrong with all runs of both directions, or of one.
struct Wrong {
  const char* mistake;
  std::function<void(Runs&)> spoil;
};

template <class One>
std::function<void(Runs&)> in_both(One one) {
  return [one](Runs& runs) {
    for (EndPose& end : runs.cw) one(end);
    for (EndPose& end : runs.ccw) one(end);
  };
}

TEST(Misfits, NameTheMistakeThatExplainsAllRuns) {
  constexpr int kExperiments = 40;
  const Wrong wrong[]{
      {"the directions were exchanged", [](Runs& runs) { std::swap(runs.cw, runs.ccw); }},
      {"x had the other sign", in_both([](EndPose& end) { end.x_m = -end.x_m; })},
      {"y had the other sign", in_both([](EndPose& end) { end.y_m = -end.y_m; })},
      {"the heading had the other sign", in_both([](EndPose& end) { end.theta_rad = -end.theta_rad; })},
      {"the headings were in degrees",
       in_both([](EndPose& end) { end.theta_rad *= 180 / std::numbers::pi; })},
      {"the headings were in radians",
       in_both([](EndPose& end) { end.theta_rad *= std::numbers::pi / 180; })},
      {"the heading had the other sign in the counter-clockwise runs", [](Runs& runs) {
         for (EndPose& end : runs.ccw) end.theta_rad = -end.theta_rad;
       }}};
  for (const Wrong& one : wrong) {
    SlippingRobot robot(14);
    int named = 0;
    for (int i = 0; i < kExperiments; ++i) {
      Runs runs = robot.squares(5);
      one.spoil(runs);
      const auto misfit = misfit_in(runs);
      named += misfit && std::ranges::count(misfit->values, one.mistake) > 0 ? 1 : 0;
    }
    std::printf("%s: named in %d of %d experiments\n", one.mistake, named, kExperiments);
    EXPECT_GE(named, kExperiments * 9 / 10) << one.mistake;
  }
}

TEST(Misfits, AreToldWhereTheSideIsWrong) {
  constexpr int kExperiments = 40;
  SlippingRobot robot(15);
  int told = 0;
  for (int i = 0; i < kExperiments; ++i) told += misfit_in(robot.squares(5), {1.5, kNominal}) ? 1 : 0;
  EXPECT_GE(told, kExperiments * 9 / 10) << "the squares had 3 m";
}

TEST(Misfits, AreNeverTheSameFileForBothDirections) {
  SlippingRobot robot(16);
  for (const int each : {1, 5}) {
    Runs runs = robot.squares(each);
    runs.ccw = runs.cw;
    EXPECT_EQ(misfit_in(runs)->kind, Kind(EndPoseProblem::same_runs));
    without_headings(runs);
    EXPECT_EQ(misfit_in(runs)->kind, Kind(EndPoseProblem::same_runs));
  }
  EXPECT_EQ(misfit_in({{{0, 0, 0}}, {{0, 0, 0}}}), std::nullopt) << "a perfect robot without noise";
}

}  // namespace
}  // namespace astro::calibration
