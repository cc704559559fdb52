#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "common/kinematics/heading_filter.hpp"

/// A reference robot that drives with a gyro, in steps of 10 ms: wheels that slip, counts, a gyro with noise, bias and scale.
/// Figures as in the noise budget of the robot and in the gyro's data sheet.
namespace astro::tests {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kUnit_32 = 2 * std::numbers::pi / 0x1p32;

/// Forward speed and yaw rate of a step.
struct Motion {
  double v_mps = 0, w_radps = 0;
};
using Course = std::vector<Motion>;

inline void add(Course& course, double seconds, Motion motion) {
  course.insert(course.end(), static_cast<std::size_t>(std::lround(seconds * 100)), motion);
}

/// Squares of 3 m from rest to rest, five seconds of standing before the first.
inline Course squares(int number, bool both_ways) {
  Course course;
  add(course, 5, {});
  for (int k = 0; k < number; ++k) {
    for (int side = 0; side < 4; ++side) {
      add(course, 10, {0.3, 0});
      add(course, 0.5, {});
      add(course, std::numbers::pi / 2, {0, both_ways && k % 2 == 1 ? -1.0 : 1.0});
      add(course, 0.5, {});
    }
  }
  return course;
}

/// Lines and spins whose yaw rate rises at 3 rad/s^2, as the robot's profiles do.
inline Course lines_and_spins(double seconds, std::mt19937_64& random) {
  Course course;
  add(course, 2, {});
  while (static_cast<double>(course.size()) < seconds * 100) {
    add(course, 10, {0.3, 0});
    add(course, 0.5, {});
    const double sense = (random() & 1U) != 0 ? 1 : -1;
    for (int i = 1; i <= 33; ++i) course.push_back({0, sense * i / 33.0});
    add(course, std::numbers::pi / 2 - 0.33, {0, sense});
    for (int i = 32; i >= 0; --i) course.push_back({0, sense * i / 33.0});
    add(course, 0.5, {});
  }
  return course;
}

/// What differs from one robot to the next.
struct Gyro {
  double scale_error = 0;
  double bias_radps = 1.5 * kDegree;
  double walk = 0.001 * kDegree;                 // rad/s per root second
  double angle_random_walk = 0.025 * kDegree;    // rad per root second
  double count_radps = 500.0 / 64000 * kDegree;  // one count of the sensor
};

/// The same robot, step by step.
class GyroDrive {
 public:
  GyroDrive(const Gyro& gyro, std::uint64_t seed) : gyro_(gyro), random_(seed), bias_(gyro.bias_radps) {
    left_ = uniform_(random_);
    right_ = uniform_(random_);
  }

  /// One step; `kick_rad` turns the robot without its wheels.
  HeadingStep advance(const Motion& motion, double kick_rad = 0) {
    constexpr double kStep_s = 0.01, kSlip_m = 2.645e-6;
    const double right_m = (motion.v_mps + motion.w_radps * kBase_m / 2) * kStep_s;
    const double left_m = (motion.v_mps - motion.w_radps * kBase_m / 2) * kStep_s;
    const double path_m = std::abs(right_m) + std::abs(left_m);
    const double turn =
        motion.w_radps * kStep_s + normal_(random_) * std::sqrt(kSlip_m * path_m) / kBase_m + kick_rad;
    true_ += turn;
    bias_ += normal_(random_) * gyro_.walk * std::sqrt(kStep_s);
    const double rate = (1 + gyro_.scale_error) * turn / kStep_s + bias_ +
                        normal_(random_) * gyro_.angle_random_walk / std::sqrt(kStep_s);
    const double read = std::round(rate / gyro_.count_radps) * gyro_.count_radps;
    const double left = std::floor(left_ + left_m / kCount_m),
                 right = std::floor(right_ + right_m / kCount_m);
    const double rolled = std::floor(right) - std::floor(right_) - (std::floor(left) - std::floor(left_));
    const double counts =
        std::abs(std::floor(right) - std::floor(right_)) + std::abs(std::floor(left) - std::floor(left_));
    left_ += left_m / kCount_m;
    right_ += right_m / kCount_m;
    wheels_ += rolled * kCount_m / kBase_m;
    HeadingStep step;
    step.gyro_48 = std::llround(read * kStep_s / kUnit_32 * 65536);
    step.wheels_32 = static_cast<std::int32_t>(std::lround(rolled * kCount_m / kBase_m / kUnit_32));
    step.path_20 = static_cast<std::uint32_t>(std::lround(counts * kCount_m * 0x1p20));
    return step;
  }

  double true_rad() const { return true_; }
  double wheels_rad() const { return wheels_; }
  double bias_radps() const { return bias_; }
  double normal() { return normal_(random_); }

  static constexpr double kBase_m = 0.29, kCount_m = std::numbers::pi * 0.072 / 2803.2;

 private:
  Gyro gyro_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  double bias_, left_ = 0, right_ = 0, true_ = 0, wheels_ = 0;
};

inline double correction_rad(const HeadingFilter& filter) {
  return static_cast<double>(filter.correction_48()) / 65536 * kUnit_32;
}

}  // namespace astro::tests
