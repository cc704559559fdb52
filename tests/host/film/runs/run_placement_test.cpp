#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/film/runs/run_placement.hpp"

/// Where in a film runs are, by how they turn and drive.
namespace astro::film {
namespace {

struct Pose {
  double x = 0, y = 0, theta = 0;
};

/// A square of 1 m with rests of two seconds: 0.4 m/s, 1.5 rad/s. `sense`: 1 to the left.
Pose square_at(double time_s, int sense) {
  constexpr double kStep_s = 0.01;
  const double turn_s = 0.5 * std::numbers::pi / 1.5;
  Pose pose;
  for (double t = 0; t < time_s; t += kStep_s) {
    const double driven = t - 2, period = 2.5 + turn_s;
    if (driven < 0 || driven > 4 * period) continue;
    const bool straight = std::fmod(driven, period) < 2.5;
    if (!straight) pose.theta += sense * 1.5 * kStep_s;
    if (straight)
      pose.x += 0.4 * kStep_s * std::cos(pose.theta), pose.y += 0.4 * kStep_s * std::sin(pose.theta);
  }
  return pose;
}

constexpr double kSquare_s = 18.2;

recording::Run run_at(double robot_s, int sense) {
  recording::Run run;
  for (double t = 0; t < kSquare_s; t += 0.05) {
    const Pose pose = square_at(t, sense);
    recording::OdometrySample sample;
    sample.time_us = std::llround(1e6 * (robot_s + t));
    sample.x_m = pose.x, sample.y_m = pose.y, sample.theta_rad = pose.theta;
    run.odometry.push_back(sample);
  }
  return run;
}

/// A film in which these squares begin at these times.
std::vector<film::FilmPose> film_with(const std::vector<std::pair<double, int>>& squares, double end_s) {
  std::vector<film::FilmPose> poses;
  for (double t = 0; t < end_s; t += 1.0 / 30) {
    film::FilmPose pose;
    pose.pts_s = pose.time_s = t;
    for (const auto& [begin_s, sense] : squares) {
      const Pose at = square_at(std::min(t - begin_s, kSquare_s), sense);
      pose.pose.x_m += at.x, pose.pose.y_m += at.y, pose.pose.theta_rad += at.theta;
    }
    poses.push_back(pose);
  }
  return poses;
}

TEST(RunPlacement, TellsEqualSquaresApartByTheRobotsClock) {
  const MotionRates film = rates_of(film_with({{5, 1}, {30, 1}, {60, 1}}, 85));
  const std::vector<MotionRates> runs{rates_of(run_at(1030, 1)), rates_of(run_at(1060, 1))};
  const std::vector<std::size_t> order{0, 1};
  for (const Placement& place : place_runs(runs, film, order)) {
    EXPECT_NEAR(place.offset_s, 1000, 0.02);  // a fifth of the window of a rate
    EXPECT_GT(place.likeness.visible, 0.98);
  }
}

TEST(RunPlacement, PutsLogsThatEachBeginAtZeroInTheirOrder) {
  const MotionRates film = rates_of(film_with({{5, 1}, {30, -1}, {60, 1}}, 85));
  const std::vector<MotionRates> runs{rates_of(run_at(0, 1)), rates_of(run_at(0, -1)),
                                      rates_of(run_at(0, 1))};
  const std::vector<std::size_t> order{0, 1, 2};
  const std::vector<Placement> places = place_runs(runs, film, order);
  EXPECT_NEAR(places[0].offset_s, -5, 0.02);
  EXPECT_NEAR(places[1].offset_s, -30, 0.02);
  EXPECT_NEAR(places[2].offset_s, -60, 0.02);
  EXPECT_TRUE(places[0].ambiguous);
  EXPECT_FALSE(places[1].ambiguous) << "the only one to the right";
}

TEST(RunPlacement, SaysHowMuchOfARunIsHidden) {
  std::vector<film::FilmPose> poses = film_with({{5, 1}}, 30);
  std::erase_if(poses, [](const film::FilmPose& pose) { return pose.time_s > 10 && pose.time_s < 14; });
  const MotionRates run = rates_of(run_at(105, 1));
  const std::vector<std::size_t> order{0};
  const std::vector<Placement> places = place_runs({&run, 1}, rates_of(poses), order);
  EXPECT_NEAR(places[0].offset_s, 100, 0.02);
  EXPECT_GT(places[0].likeness.visible, 0.98);
  EXPECT_NEAR(places[0].likeness.shown, 1 - 4.0 / 14.2, 0.1);
}

TEST(RunPlacement, AnotherDriveIsNotAlike) {
  const MotionRates run = rates_of(run_at(0, 1));
  const std::vector<std::size_t> order{0};
  EXPECT_LT(place_runs({&run, 1}, rates_of(film_with({{5, -1}}, 30)), order)[0].likeness.visible, 0.9);
}

}  // namespace
}  // namespace astro::film
