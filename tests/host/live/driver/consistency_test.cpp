#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "host/calibration/likelihood/pose_uncertainty.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/support/robots/desk.hpp"
#include "tests/support/ros2/robot_on_ros.hpp"

/// The covariance in /odom is that of the errors in /odom: over many robots, each of which differs from its parameters as a
/// calibration leaves it, the errors of its pose divided by their covariance have the mean square of their number.
namespace astro::live {

namespace {

using calibration::FactorCovariance;

constexpr int kDrives = 200;
constexpr std::array kMoments_s{5, 20, 60};
// Of the mean of 200 chi-squares of 3 degrees of freedom: the quantiles of chi-square of 600, divided by 200.
constexpr double kLeast = 2.666, kMost = 3.349;

/// Of what a calibration of the thesis's robot by some squares leaves: c_R, c_L, b, e. The errors of both wheels go together,
/// because the common scale is known worse than their ratio; the curvature is known to half a per cent.
FactorCovariance left_by_a_calibration() {
  FactorCovariance root = FactorCovariance::Zero();
  root.col(0) << 4e-4, 4e-4, 0.29 * 4e-4, 0;  // scale
  root.col(1) << 1e-4, -1e-4, 0, 0;           // ratio of the wheels
  root.col(2) << 0, 0, 0.29 * 1e-3, -1e-3;    // wheelbase
  root.col(3) << 0, 0, 0, 5e-3;               // curvature
  return root * root.transpose();
}

/// A robot that is not what its parameters say.
sim::Config drawn(const FactorCovariance& covariance, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Vector4d error =
      Eigen::LLT<FactorCovariance>(covariance).matrixL() *
      Eigen::Vector4d(normal(random), normal(random), normal(random), normal(random));
  sim::Config config;
  const double c_r = 1 + error[0], c_l = 1 + error[1];
  config.true_ed = c_r / c_l;
  config.scale = (c_r + c_l) / 2;
  config.true_wheelbase_m = config.nominal_wheelbase_m + error[2];
  config.true_e = error[3];
  config.slip_m = support::kThesisSlip_m;
  config.seed = random();
  return config;
}

constexpr unsigned kSeed = 20261124;

DriverOptions calibrated(const FactorCovariance& covariance) {
  DriverOptions options = support::RobotOnRos::of_both_types();
  options.errors = calibration::OdometryErrors{support::kThesisSlip_m, covariance};
  options.velocities_after_stop = true;  // the drive stops several times to be compared with the truth
  return options;
}

/// Normalised squared errors of a pose.
struct Nees {
  double ours = 0, typed = 0;
};

Nees normalised(const ros2::msg::Odometry& odometry, const sim::Pose& truth) {
  const ros2::msg::PoseWithCovariance& pose = odometry.pose;
  const Eigen::Vector3d error{
      pose.pose.position.x - truth.x_m, pose.pose.position.y - truth.y_m,
      std::remainder(ros2::heading_of(pose.pose.orientation) - truth.theta_rad, 2 * std::numbers::pi)};
  constexpr std::array<std::size_t, 3> kRows{0, 1, 5};
  Eigen::Matrix3d covariance;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      covariance(i, k) =
          pose.covariance[6 * kRows[static_cast<std::size_t>(i)] + kRows[static_cast<std::size_t>(k)]];
  // What drivers of other robots publish, as somebody once typed it.
  const Eigen::Matrix3d typed = Eigen::Vector3d(1e-3, 1e-3, 1e-2).asDiagonal();
  return {error.dot(covariance.llt().solve(error)), error.dot(typed.llt().solve(error))};
}

/// A drive at random by /cmd_vel.
class RandomDrive {
 public:
  /// `topic`: the odometry that is compared.
  RandomDrive(const sim::Config& config, const FactorCovariance& covariance, std::uint64_t seed,
              std::string topic = "/odom")
      : bench_(config, calibrated(covariance)), random_(seed), topic_(std::move(topic)) {
    if (config.gyro) {
      bench_.run_ms(300);
      bench_.set_elsewhere("gyro_axis", 3);
      bench_.run_ms(1000);  // until the bias is known
    }
    bench_.run_ms(300);
    EXPECT_TRUE(bench_.call("/arm").success);
  }

  Nees until(double time_s) {
    std::uniform_real_distribution<double> speed(-0.2, 0.4), yaw_rate(-0.8, 0.8);
    for (; driven_s_ < time_s; ++driven_s_) {
      const double v_mps = speed(random_), omega_radps = yaw_rate(random_);
      for (int i = 0; i < 5; ++i) {
        bench_.say_velocity(v_mps, omega_radps);
        bench_.run_ms(200);
      }
    }
    bench_.call("/stop");  // so that truth and the last message are of one moment
    bench_.run_ms(2000);
    return normalised(bench_.ros.newest<ros2::msg::Odometry>(topic_), bench_.robot->board().truth());
  }

 private:
  support::RobotOnRos bench_;
  std::mt19937_64 random_;
  std::string topic_;
  double driven_s_ = 0;
};

TEST(PublishedCovariance, IsThatOfTheErrorsOfTwoHundredRobots) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  std::mt19937_64 random(kSeed);
  const FactorCovariance covariance = left_by_a_calibration();
  std::array<Nees, kMoments_s.size()> mean{};
  for (int i = 0; i < kDrives; ++i) {
    RandomDrive drive(drawn(covariance, random), covariance, random());
    for (std::size_t moment = 0; moment < kMoments_s.size(); ++moment) {
      const Nees nees = drive.until(kMoments_s[moment]);
      mean[moment].ours += nees.ours / kDrives;
      mean[moment].typed += nees.typed / kDrives;
    }
  }
  std::printf("%d robots, seed %u: mean normalised squared error of /odom, of 3 (95 %%: %.2f to %.2f)\n",
              kDrives, kSeed, kLeast, kMost);
  for (std::size_t moment = 0; moment < kMoments_s.size(); ++moment) {
    std::printf("  after %2d s  %.2f   with a constant diagonal %.3g\n", kMoments_s[moment],
                mean[moment].ours, mean[moment].typed);
    EXPECT_GT(mean[moment].ours, kLeast) << kMoments_s[moment];
    EXPECT_LT(mean[moment].ours, kMost) << kMoments_s[moment];
  }
}

TEST(PublishedCovariance, WithAGyroIsThatOfTheErrorsOfTwoHundredRobots) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  std::mt19937_64 random(kSeed + 1);
  std::normal_distribution<double> normal;
  const FactorCovariance covariance = left_by_a_calibration();
  std::array<double, kMoments_s.size()> mean{};
  for (int i = 0; i < kDrives; ++i) {
    sim::Config config = drawn(covariance, random);
    config.gyro.emplace().scale = 1 + calibration::GyroErrors().scale * normal(random);
    RandomDrive drive(config, covariance, random(), "/odom_gyro");
    for (std::size_t moment = 0; moment < kMoments_s.size(); ++moment)
      mean[moment] += drive.until(kMoments_s[moment]).ours / kDrives;
  }
  std::printf("%d robots, seed %u: mean normalised squared error of /odom_gyro, of 3 (95 %%: %.2f to %.2f)\n",
              kDrives, kSeed + 1, kLeast, kMost);
  for (std::size_t moment = 0; moment < kMoments_s.size(); ++moment) {
    std::printf("  after %2d s  %.2f\n", kMoments_s[moment], mean[moment]);
    EXPECT_GT(mean[moment], kLeast) << kMoments_s[moment];
    EXPECT_LT(mean[moment], kMost) << kMoments_s[moment];
  }
}

}  // namespace

}  // namespace astro::live
