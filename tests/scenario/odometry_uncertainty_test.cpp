#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "host/calibration/likelihood/pose_uncertainty.hpp"
#include "host/recording/telemetry_sample.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/support/robots/calibrated_robots.hpp"
#include "tests/support/robots/desk.hpp"

/// The uncertainty that odometry states is that which it has: over many robots, each of which differs from its parameters as a
/// calibration leaves it, the errors of its odometry divided by their covariance have the mean square of their number.
namespace astro {
namespace {

using calibration::FactorCovariance;
using calibration::PoseUncertainty;
using calibration::Symmetric3;
using std::chrono::milliseconds;
using support::drawn, support::left_by_a_calibration;
using support::kDrives, support::kLeast, support::kMoments_s, support::kMost;

constexpr unsigned kSeed = 20261124;

/// A drive at random under velocities, and what its odometry states.
class Drive {
 public:
  Drive(const sim::Config& config, const FactorCovariance& covariance, std::uint64_t seed)
      : desk_(config),
        uncertainty_({1, 1, config.nominal_wheelbase_m}, {config.slip_m, covariance}),
        count_m_(std::numbers::pi * config.nominal_diameter_m /
                 (config.counts_per_motor_rev * config.gear_ratio)),
        random_(seed),
        subscription_(desk_.client.on<protocol::Telemetry>(
            [this](const protocol::Telemetry& telemetry) { take(recording::to_sample(telemetry)); })) {
    const sim::Pose truth = desk_.robot->board().truth();
    desk_.client.request(protocol::SetPose{});
    start_ = truth;
    desk_.client.request(protocol::SetTelemetry{20, protocol::Telemetry::kAll});
    session_.emplace(desk_.client);
  }

  void until(double time_s) {
    std::uniform_real_distribution<double> speed(-0.2, 0.4), yaw_rate(-0.8, 0.8);
    while (driven_s_ < time_s) {
      const double v_mps = speed(random_), omega_radps = yaw_rate(random_);
      for (int i = 0; i < 10; ++i) {
        session_->set_velocity(v_mps, omega_radps);
        session_->pump(milliseconds(100));
      }
      driven_s_ += 1;
    }
    session_->stop();  // so that truth and the last sample are of one moment
    session_->pump(milliseconds(100));
  }

  /// Of odometry, in its own frame.
  Eigen::Vector3d error() const {
    const sim::Pose truth = desk_.robot->board().truth();
    const double c = std::cos(start_.theta_rad), s = std::sin(start_.theta_rad);
    const double dx = truth.x_m - start_.x_m, dy = truth.y_m - start_.y_m;
    return {now_.x_m - (c * dx + s * dy), now_.y_m - (c * dy - s * dx),
            std::remainder(now_.theta_rad - (truth.theta_rad - start_.theta_rad), 2 * std::numbers::pi)};
  }
  Eigen::Matrix3d covariance() const {
    const auto rows = uncertainty_.covariance().full();
    Eigen::Matrix3d matrix;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        matrix(i, k) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
    return matrix;
  }

 private:
  void take(const recording::OdometrySample& sample) {
    if (seen_)
      uncertainty_.travel(count_m_ * (sample.right_counts - now_.right_counts),
                          count_m_ * (sample.left_counts - now_.left_counts));
    seen_ = true;
    now_ = sample;
  }

  support::Desk desk_;
  PoseUncertainty uncertainty_;
  double count_m_;
  std::mt19937_64 random_;
  sim::Pose start_;
  recording::OdometrySample now_;
  bool seen_ = false;
  double driven_s_ = 0;
  robot::Subscription subscription_;
  std::optional<robot::DriveSession> session_;
};

double normalised(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
  return error.dot(covariance.llt().solve(error));
}

TEST(OdometryUncertainty, IsThatOfTheErrorsOfTwoHundredRobots) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  std::mt19937_64 random(kSeed);
  const FactorCovariance covariance = left_by_a_calibration();
  // What drivers of other robots publish, as somebody once typed it.
  const Eigen::Matrix3d typed = Eigen::Vector3d(1e-3, 1e-3, 1e-2).asDiagonal();
  std::array<double, 3> ours{}, theirs{};
  for (int i = 0; i < kDrives; ++i) {
    Drive drive(drawn(covariance, random), covariance, random());
    for (std::size_t moment = 0; moment < kMoments_s.size(); ++moment) {
      drive.until(kMoments_s[moment]);
      ours[moment] += normalised(drive.error(), drive.covariance()) / kDrives;
      theirs[moment] += normalised(drive.error(), typed) / kDrives;
    }
  }
  std::printf("%d robots, seed %u: mean normalised squared error, of 3 (95 %%: %.2f to %.2f)\n", kDrives,
              kSeed, kLeast, kMost);
  for (std::size_t moment = 0; moment < kMoments_s.size(); ++moment) {
    std::printf("  after %2d s  %.2f   with a constant diagonal %.3g\n", kMoments_s[moment], ours[moment],
                theirs[moment]);
    EXPECT_GT(ours[moment], kLeast) << kMoments_s[moment];
    EXPECT_LT(ours[moment], kMost) << kMoments_s[moment];
  }
}

}  // namespace
}  // namespace astro
