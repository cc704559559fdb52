#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/likelihood/noise_slope.hpp"
#include "host/calibration/motion/wheel_path.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "host/calibration/preparation/preparation.hpp"
#include "tests/host/calibration/ml_drives.hpp"

// The filter against what it stands for: the normal distribution of all truth samples of a drive at once,
// with a dense covariance, derivatives by finite differences, and not a line of the filter's code.
namespace astro::calibration {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

struct Scene {
  Trajectory trajectory;
  PreparedRun run;
  Unknowns unknowns = Unknowns::Zero();
  NoiseModel noise;
};

/// A second of an arc and a spin: small enough for a dense matrix.
Scene scene(bool headings) {
  Scene scene;
  simulation::study::DriveModel model = astro_drive();
  model.truth_rate_hz = 20;
  model.headings = headings;
  const simulation::study::Course course{{simulation::study::Leg::Kind::turn, 0.3, 0.7, 0},
                                         {simulation::study::Leg::Kind::turn, 0, -0.8, 0}};
  scene.trajectory = simulation::study::synthetic_drive(course, model, "run", kSeed);
  scene.run = prepare(std::vector{scene.trajectory}, model.loaded, true, Density::all).runs.front();
  scene.run.source = &scene.trajectory;
  scene.unknowns << model.actual.c_r, model.actual.c_l, model.actual.b_m, 0.02, 0.03, -0.02, 0.4, 0.001, 0.1,
      0.2, 0.3, 0.002;
  scene.noise = model.noise;
  return scene;
}

int freedom(const Scene& scene) { return scene.run.has_headings ? 3 : 2; }

/// All truth samples as they should be, given the slip of each wheel in each of the filter's steps.
Vector body_path(const Scene& scene, const Unknowns& u, const Vector& slip_m) {
  const WheelPath wheels(scene.trajectory.wheels);
  const int n = freedom(scene);
  Vector all(n * static_cast<int>(scene.run.truth.size()));
  double x = u[kStartX], y = u[kStartY], theta = u[kStartTheta];
  WheelState before;
  for (int i = 0; i < static_cast<int>(scene.run.truth.size()); ++i) {
    const double t = scene.run.truth[static_cast<std::size_t>(i)].time_s;
    const WheelState now = wheels.at(t + u[kClockOffset] + u[kSkew] * (t - scene.run.clock_middle_s));
    if (i > 0) {
      const double left = u[kCLeft] * (now.left_m - before.left_m) + slip_m[2 * i];
      const double right = u[kCRight] * (now.right_m - before.right_m) + slip_m[2 * i + 1];
      const double curve = std::abs(right - left) / (std::abs(right + left) / 2) / 0.12;
      const double turn = (right - left) / (u[kB] * (1 + u[kE] / (1 + curve))), middle = theta + turn / 2;
      const double chord = (left + right) / 2 * (std::abs(turn) < 1e-9 ? 1 : std::sin(turn / 2) / (turn / 2));
      x += chord * std::cos(middle);
      y += chord * std::sin(middle);
      theta += turn;
    }
    before = now;
    all[n * i] = x + std::cos(theta) * u[kLeverX] - std::sin(theta) * u[kLeverY];
    all[n * i + 1] = y + std::sin(theta) * u[kLeverX] + std::cos(theta) * u[kLeverY];
    if (n == 3) all[n * i + 2] = theta + u[kLeverYaw];
  }
  return all;
}

Matrix derivative(const Vector& at, double step, auto function) {
  Matrix by;
  for (int i = 0; i < at.size(); ++i) {
    Vector up = at, down = at;
    up[i] += step;
    down[i] -= step;
    const Vector slope = (function(up) - function(down)) / (2 * step);
    if (i == 0) by.resize(slope.size(), at.size());
    by.col(i) = slope;
  }
  return by;
}

Matrix dense_covariance(const Scene& scene) {
  const int count = static_cast<int>(scene.run.truth.size()), n = freedom(scene);
  const Matrix by_slip = derivative(Vector::Zero(2 * count), 1e-5, [&](const Vector& slip_m) {
    return body_path(scene, scene.unknowns, slip_m);
  });
  const WheelPath wheels(scene.trajectory.wheels);
  Vector variance = Vector::Zero(2 * count);
  WheelState before;
  for (int i = 0; i < count; ++i) {
    const double t = scene.run.truth[static_cast<std::size_t>(i)].time_s;
    const WheelState now =
        wheels.at(t + scene.unknowns[kClockOffset] + scene.unknowns[kSkew] * (t - scene.run.clock_middle_s));
    if (i > 0) {
      variance[2 * i] = scene.noise.K_m * std::abs(now.left_m - before.left_m);
      variance[2 * i + 1] = scene.noise.K_m * std::abs(now.right_m - before.right_m);
    }
    before = now;
  }
  Matrix covariance = by_slip * variance.asDiagonal() * by_slip.transpose();
  for (int i = 0; i < covariance.rows(); ++i) {
    const double sigma = i % n == 2 ? scene.noise.sigma_theta_rad : scene.noise.sigma_xy_m;
    covariance(i, i) += sigma * sigma;
  }
  return covariance;
}

class Innovations : public testing::TestWithParam<bool> {};

TEST_P(Innovations, CarryTheInformationOfTheWholeDriveAtOnce) {
  const Scene scene = astro::calibration::scene(GetParam());
  const Matrix by = derivative(scene.unknowns, 1e-6, [&](const Vector& u) {
    return body_path(scene, u, Vector::Zero(2 * static_cast<int>(scene.run.truth.size())));
  });
  const Matrix dense = by.transpose() * dense_covariance(scene).ldlt().solve(by);
  const Matrix filtered = expected_information(Moves(scene.run, scene.unknowns), scene.noise);
  for (int i = 0; i < kUnknowns; ++i)
    for (int k = 0; k < kUnknowns; ++k) {
      if (!GetParam() && (i == kLeverYaw || k == kLeverYaw)) continue;
      // Finite differences of steps of 1e-6 leave some 1e-6 of each entry; the wheels' rate is a cubic's.
      const double size = std::sqrt(dense(i, i) * dense(k, k));
      // The derivative by e is at mean speeds over a little more than each step, here of a drive in which speeds change.
      const double tolerance = i == kE || k == kE ? 3e-3 : 2e-5;
      EXPECT_NEAR(filtered(i, k) / size, dense(i, k) / size, tolerance) << i << ' ' << k;
    }
}

TEST_P(Innovations, HaveTheLikelihoodOfTheWholeDriveAtOnce) {
  const Scene scene = astro::calibration::scene(GetParam());
  const int count = static_cast<int>(scene.run.truth.size()), n = freedom(scene);
  Unknowns u = scene.unknowns;
  u.segment<3>(kStartX).setZero();
  u[kSkew] = u[kClockOffset] = 0;
  Scene at = scene;
  at.unknowns = u;
  Vector misses = -body_path(at, u, Vector::Zero(2 * count));
  for (int i = 0; i < count; ++i) {
    const BodySample& sample = scene.run.truth[static_cast<std::size_t>(i)];
    misses[n * i] += sample.x_m;
    misses[n * i + 1] += sample.y_m;
    if (n == 3) misses[n * i + 2] = std::remainder(misses[n * i + 2] + sample.theta_rad, 2 * M_PI);
  }
  const Eigen::LDLT<Matrix> covariance(dense_covariance(at));
  const double chi_square = misses.dot(covariance.solve(misses));
  const double cost = chi_square + covariance.vectorD().array().log().sum();
  const InnovationSums sums = innovations(Moves(scene.run, u), scene.noise, {});
  EXPECT_EQ(sums.degrees_of_freedom, n * count);
  // The filter linearises about what it has seen, the dense matrix about the prediction: a mrad of heading
  // apart.
  EXPECT_NEAR(sums.cost, cost, 0.05);
  EXPECT_NEAR(sums.chi_square, chi_square, 0.05);
}

TEST_P(Innovations, HaveAThirdComponentWhereThereAreHeadingsAndAnExactZeroElsewhere) {
  const Scene scene = astro::calibration::scene(GetParam());
  double sum = 0;
  for (const Eigen::Vector3d& e : standardised_innovations(Moves(scene.run, scene.unknowns), scene.noise,
                                                           RobustMode::tracker_and_wheels, {}))
    sum += std::abs(e[2]);
  EXPECT_EQ(sum > 0, GetParam());
}

TEST_P(Innovations, FallWithTheNoiseAsTheSlopeSays) {
  const Scene scene = astro::calibration::scene(GetParam());
  // Away from the truth, where leaving out that the innovations change with the gain would show.
  for (const double factor : {0.1, 1.0, 10.0}) {
    const NoiseModel noise{scene.noise.K_m * factor, scene.noise.sigma_xy_m * 1.5,
                           scene.noise.sigma_theta_rad / 1.5};
    Unknowns u = scene.unknowns;
    u.segment<3>(kStartX).setZero();
    const NoiseSlope slope = innovations_and_noise(Moves(scene.run, u), noise).second;
    const auto cost = [&](double K, double xy, double theta) {
      return innovations(Moves(scene.run, u),
                         {noise.K_m * std::exp(K), noise.sigma_xy_m * std::exp(xy / 2),
                          noise.sigma_theta_rad * std::exp(theta / 2)},
                         {})
          .cost;
    };
    constexpr double kStep = 1e-4;
    const double by[3] = {(cost(kStep, 0, 0) - cost(-kStep, 0, 0)) / (2 * kStep),
                          (cost(0, kStep, 0) - cost(0, -kStep, 0)) / (2 * kStep),
                          (cost(0, 0, kStep) - cost(0, 0, -kStep)) / (2 * kStep)};
    for (int i = 0; i < 3; ++i) {
      // What the linearisation itself moves with the noise is left out of the slope.
      EXPECT_NEAR(slope.gradient[i], by[i], 2e-3 * (1 + std::abs(by[i]))) << factor << ' ' << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutHeadings, Innovations, testing::Bool());

TEST(Innovations, OfTheStretchesOfARunAddUpToThoseOfTheRun) {
  const Scene scene = ::astro::calibration::scene(true);
  const Moves moves(scene.run, scene.unknowns);
  const InnovationSums whole = innovations(moves, scene.noise);
  const std::vector<InnovationSums> stretches =
      innovations_by_stretch(moves, scene.noise, RobustMode::none, {}, 3);
  ASSERT_EQ(stretches.size(), 3U);
  Information information = Information::Zero();
  Unknowns gradient = Unknowns::Zero();
  for (const InnovationSums& stretch : stretches) {
    EXPECT_GT(stretch.information.norm(), 0.01 * whole.information.norm());
    information += stretch.information;
    gradient += stretch.gradient;
  }
  EXPECT_LT((information - whole.information).norm(), 1e-12 * whole.information.norm());
  EXPECT_LT((gradient - whole.gradient).norm(), 1e-9 * whole.gradient.norm());
}

}  // namespace
}  // namespace astro::calibration
