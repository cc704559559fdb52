#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "host/calibration/gyro/gyro_calibration.hpp"
#include "tests/host/calibration/ml_drives.hpp"

/// Drives of a robot like the thesis's that carries a gyro.
namespace astro::calibration {

inline constexpr double kDegree_rad = 0.017453292519943295;

/// What a FXAS21002C has (hal/sim/config.hpp).
struct GyroModel {
  double scale = 1, lag_s = 0, bias_radps = 0.02;
  double random_walk_radprs = 0.025 * kDegree_rad, bias_walk = 0.001 * kDegree_rad;  // per root second
};

/// A turn that no wheel sees, in a tenth of a second.
struct Kick {
  double time_s = -1, turn_rad = 0;
};

/// Rounds to the counts of the reference robot, with the slip of its tyres; the truth is exact until with_gyro() adds its noise.
inline simulation::study::DriveModel gyro_robot() {
  simulation::study::DriveModel model = astro_drive();
  model.noise.sigma_xy_m = model.noise.sigma_theta_rad = 1e-12;
  model.metres_per_count = 3.14159265358979 * 0.072 / 2803.2;
  return model;
}

/// The run with a gyro that samples when the tracker does.
inline GyroDrive with_gyro(Trajectory run, const GyroModel& gyro, std::uint64_t seed, const Kick& kick = {}) {
  constexpr double kKick_s = 0.1, kTracker_rad = 0.15 * kDegree_rad;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (std::size_t k = 1; k < run.truth.size(); ++k)
    run.truth[k].theta_rad =
        run.truth[k - 1].theta_rad + wrapped_rad(run.truth[k].theta_rad - run.truth[k - 1].theta_rad);
  if (kick.time_s >= 0) {
    const auto kicked = std::ranges::lower_bound(run.truth, kick.time_s, {}, &BodySample::time_s);
    const Pose2 place{kicked->x_m, kicked->y_m, 0};
    for (BodySample& body : std::span(kicked, run.truth.end())) {
      const double turn_rad = kick.turn_rad * std::min(1.0, (body.time_s - kick.time_s) / kKick_s);
      const Pose2 now = Pose2{place.x_m, place.y_m, turn_rad} *
                        Pose2{body.x_m - place.x_m, body.y_m - place.y_m, body.theta_rad};
      body = {body.time_s, now.x_m, now.y_m, body.theta_rad + turn_rad};
    }
  }
  const auto heading_rad = [&](double time_s) {
    std::size_t k = 1;
    const double per_s =
        static_cast<double>(run.truth.size() - 1) / (run.truth.back().time_s - run.truth.front().time_s);
    const double guess = (time_s - run.truth.front().time_s) * per_s;
    if (guess > 1) k = std::min(run.truth.size() - 1, static_cast<std::size_t>(guess));
    while (k + 1 < run.truth.size() && run.truth[k].time_s < time_s) ++k;
    while (k > 1 && run.truth[k - 1].time_s > time_s) --k;
    const BodySample &a = run.truth[k - 1], &b = run.truth[k];
    const double part = std::clamp((time_s - a.time_s) / (b.time_s - a.time_s), 0.0, 1.0);
    return a.theta_rad + part * (b.theta_rad - a.theta_rad);
  };
  GyroDrive drive{run.name, run.wheels, {}, {}, gyro_robot().metres_per_count};
  double bias_radps = gyro.bias_radps;
  for (std::size_t k = 1; k < run.truth.size(); ++k) {
    const double time_s = run.truth[k].time_s, dt_s = time_s - run.truth[k - 1].time_s;
    const double turn_rad = heading_rad(time_s - gyro.lag_s) - heading_rad(time_s - dt_s - gyro.lag_s);
    bias_radps += gyro.bias_walk * std::sqrt(dt_s) * normal(random);
    drive.rates.push_back({time_s, gyro.scale * turn_rad / dt_s + bias_radps +
                                       gyro.random_walk_radprs / std::sqrt(dt_s) * normal(random)});
  }
  for (BodySample& body : run.truth)
    body.theta_rad = wrapped_rad(body.theta_rad + kTracker_rad * normal(random));
  drive.truth = std::move(run.truth);
  return drive;
}

/// Ten squares of 2 m, both ways round.
inline std::vector<GyroDrive> gyro_squares(const GyroModel& gyro, std::uint64_t seed) {
  std::vector<GyroDrive> drives;
  for (const Trajectory& run : squares(gyro_robot(), 10, 2, seed))
    drives.push_back(with_gyro(run, gyro, seed * 100 + drives.size()));
  return drives;
}

}  // namespace astro::calibration
