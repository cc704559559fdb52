#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <iostream>
#include <numbers>
#include <numeric>

#include "host/film/camera/floor_start.hpp"
#include "host/film/camera/frame_pose.hpp"
#include "host/film/camera/scale_error.hpp"
#include "host/film/camera/scene_fit.hpp"
#include "tests/host/film/camera/synthetic_scene.hpp"

namespace astro::film {
namespace {

Figures exact_figures(const Scene& truth) {
  Figures figures{{truth.floor_side_m, 4e-4}, {truth.robot_side_m, 4e-4}, {truth.robot_height_m, 2e-3}};
  const FloorTag& far = truth.tags[3];
  figures.tapes = {{1, far.id, {std::hypot(far.pose.x_m, far.pose.y_m), 2e-3}}};
  return figures;
}

/// From nothing but corners and figures, as for a film.
SceneFit fitted(const Scene& truth, const std::vector<TagCorners>& floor, std::vector<RobotSighting> robot,
                const Figures& figures) {
  std::vector<SeenFloorTag> tags;
  for (std::size_t i = 0; i < floor.size(); ++i) tags.push_back({truth.tags[i].id, floor[i]});
  Scene start = floor_start(tags, truth.width_px, truth.height_px, figures.floor_side_m.value).value();
  start.robot_height_m = figures.robot_height_m.value;
  start.robot_side_m = figures.robot_side_m.value;
  start.readout_s = truth.readout_s;
  const SceneFit alone = fit_floor(start, floor, figures);
  for (RobotSighting& one : robot) one.pose = rough_pose(alone.scene, one.corners).value();
  return fit_scene(alone.scene, floor, std::move(robot), figures);
}

/// Distances between places at which the robot was.
std::vector<double> distances_in(const std::vector<RobotSighting>& robot) {
  std::vector<double> all;
  const std::size_t apart = robot.size() / 3;
  for (std::size_t i = 0; i + apart < robot.size(); ++i) {
    const Pose2 &a = robot[i].pose, &b = robot[i + apart].pose;
    all.push_back(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m));
  }
  return all;
}

/// Found over true.
double factor_of(const SceneFit& fit, const std::vector<RobotSighting>& truth) {
  const std::vector<double> found = distances_in(fit.robot), real = distances_in(truth);
  return std::accumulate(found.begin(), found.end(), 0.0) / std::accumulate(real.begin(), real.end(), 0.0);
}

TEST(SceneFit, ReturnsTheSceneThatMadeTheCorners) {
  for (const Scene& truth : {support::phone_scene(), support::ceiling_scene()}) {
    const std::vector<RobotSighting> robot = support::seen_robot(truth, 200);
    const SceneFit fit = fitted(truth, support::seen_floor(truth), robot, exact_figures(truth));
    EXPECT_TRUE(fit.converged);
    // Corners are exact. Only priors whose mean is not the truth pull a little: lens, edges, tilt, the usual focal length.
    EXPECT_LT(fit.floor_rms_px, 0.01);
    EXPECT_LT(fit.robot_rms_px, 0.02);
    const double factor = factor_of(fit, robot);
    EXPECT_NEAR(factor, 1,
                1e-3);  // from straight above the focal length shows only in the height of one small tag
    const std::vector<double> found = distances_in(fit.robot), real = distances_in(robot);
    for (std::size_t i = 0; i < real.size(); ++i) EXPECT_NEAR(found[i] / factor, real[i], 2e-4);
  }
}

constexpr int kTrials = 24, kSeed = 20261124;
const TagCorners kNone{Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0),
                       Eigen::Vector2d(0, 0)};

/// The squared error of the scale over its variance, for corners and figures that are off by what they may be. `alike` are errors
/// of the robot's corners that all pictures share.
double scale_miss(const Scene& truth, std::size_t pictures, double noise_px, const TagCorners& alike,
                  std::mt19937& random) {
  const std::vector<RobotSighting> exact = support::seen_robot(truth, pictures);
  std::vector<Eigen::Vector2d> pixels;
  for (const RobotSighting& one : exact) pixels.push_back(center_of(one.corners));
  std::vector<TagCorners> floor = support::seen_floor(truth);
  for (TagCorners& corners : floor) support::add_noise(corners, 0.03, random);
  std::vector<RobotSighting> robot = exact;
  for (RobotSighting& one : robot) {
    support::add_noise(one.corners, noise_px, random);
    // They turn with the tag, as a picture does: its y points down.
    const Eigen::Rotation2Dd turn(-one.pose.theta_rad);
    for (std::size_t i = 0; i < alike.size(); ++i) one.corners[i] += turn * alike[i];
  }
  Figures figures = exact_figures(truth);
  const auto misread = [&](Measured& value) {
    value.value += std::normal_distribution<double>(0, value.sigma)(random);
  };
  misread(figures.floor_side_m), misread(figures.robot_side_m), misread(figures.robot_height_m);
  misread(figures.tapes[0].length_m);
  const SceneFit fit = fitted(truth, floor, robot, figures);
  EXPECT_TRUE(fit.converged);
  EXPECT_LE(fit.iterations, 30);
  const double sigma = scale_error(fit.scene, figures, fit.covariance, pixels);
  return std::pow((factor_of(fit, exact) - 1) / sigma, 2);
}

void expect_chi_square(double squares) {
  std::cout << "seed " << kSeed << ", chi-square " << squares << " of " << kTrials << "\n";
  // 0.1 % and 99.9 % of chi-square with 24 degrees of freedom.
  EXPECT_GT(squares, 8.1);
  EXPECT_LT(squares, 51.2);
}

TEST(SceneFit, KnowsTheErrorOfItsScale) {
  std::mt19937 random(kSeed);
  double squares = 0;
  for (int trial = 0; trial < kTrials; ++trial)
    squares += scale_miss(support::phone_scene(), 60, 0.2, kNone, random);
  expect_chi_square(squares);
}

// Where the focal length hardly shows, errors that all pictures share would make one up.
TEST(SceneFit, KnowsTheErrorOfItsScaleFromStraightAboveWithAnyPhone) {
  std::mt19937 random(kSeed);
  double squares = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Scene truth = support::ceiling_scene();
    const double factor = std::uniform_real_distribution<double>(0.8, 1.2)(random);
    truth.camera.f_px *= factor;
    truth.camera.position_m.z() *= factor;
    truth.robot_shift_px = truth.floor_shift_px + std::normal_distribution<double>(0, 0.1)(random);
    TagCorners alike = kNone;
    support::add_noise(alike, 0.03, random);
    squares += scale_miss(truth, 60, 0.1, alike, random);
  }
  expect_chi_square(squares);
}

TEST(FramePose, HasTheCovarianceThatItsErrorsHave) {
  const Scene scene = support::phone_scene();
  constexpr double kSigma_px = 0.1;
  std::mt19937 random(kSeed);
  double chi = 0;
  int count = 0;
  for (RobotSighting one : support::seen_robot(scene, 300)) {
    const Pose2 truth = one.pose;
    support::add_noise(one.corners, kSigma_px, random);
    const auto found = frame_pose(scene, one.corners, rough_pose(scene, one.corners).value(), one.velocity);
    ASSERT_TRUE(found);
    const Eigen::Vector3d off(found->pose.x_m - truth.x_m, found->pose.y_m - truth.y_m,
                              std::remainder(found->pose.theta_rad - truth.theta_rad, 2 * std::numbers::pi));
    const Eigen::Matrix3d covariance = kSigma_px * kSigma_px * found->cofactor;
    chi += off.dot(covariance.inverse() * off);
    count += 3;
  }
  // Three standard deviations of chi-square over its degrees of freedom.
  EXPECT_NEAR(chi / count, 1, 3 * std::sqrt(2.0 / count)) << "seed " << kSeed;
}

TEST(FramePose, IsThatOfTheMeanRowWhileTheRobotMoves) {
  const Scene scene = support::phone_scene();
  for (const RobotSighting& one : support::seen_robot(scene, 50)) {
    const auto found = frame_pose(scene, one.corners, rough_pose(scene, one.corners).value(), one.velocity);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->pose.x_m, one.pose.x_m, 1e-6);
    EXPECT_NEAR(std::remainder(found->pose.theta_rad - one.pose.theta_rad, 2 * std::numbers::pi), 0, 1e-6);
  }
}

}  // namespace
}  // namespace astro::film
