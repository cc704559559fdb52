#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "host/calibration/motion/arc.hpp"
#include "host/lidar/scanned_drive.hpp"

/// Rooms of straight walls, and robots with known factors that drive in them, without firmware and forces.
namespace astro::lidar {

struct Wall {
  Point2 from, to;
};
using Room = std::vector<Wall>;

/// Walls around these corners, in order.
inline void add_walls(Room& room, const std::vector<Point2>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    room.push_back({corners[i], corners[(i + 1) % corners.size()]});
}

/// 10 m by 8 m with a niche, a cupboard and a slanted board, so that no two places look alike.
inline Room furnished_room() {
  Room room;
  add_walls(room, {{-5, -4}, {5, -4}, {5, 2}, {4, 2}, {4, 4}, {-5, 4}});
  add_walls(room, {{-4.4, 3.0}, {-3.2, 3.0}, {-3.2, 3.6}, {-4.4, 3.6}});
  add_walls(room, {{3.4, -3.5}, {4.4, -2.7}, {4.3, -2.5}, {3.3, -3.3}});
  return room;
}

/// Two parallel walls without ends in sight.
inline Room corridor() { return {{{-500, -1.2}, {500, -1.2}}, {{500, 1.2}, {-500, 1.2}}}; }

/// Distance to the nearest point of a wall.
inline double off_walls_m(const Room& room, const Point2& point) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Wall& wall : room) {
    const double dx = wall.to.x_m - wall.from.x_m, dy = wall.to.y_m - wall.from.y_m,
                 px = point.x_m - wall.from.x_m, py = point.y_m - wall.from.y_m;
    const double part = std::clamp((px * dx + py * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    nearest_m = std::min(nearest_m, std::hypot(px - part * dx, py - part * dy));
  }
  return nearest_m;
}

/// Distance to the nearest wall along a ray; infinite if there is none.
inline double distance_m(const Room& room, const Pose2& ray) {
  const double c = std::cos(ray.theta_rad), s = std::sin(ray.theta_rad);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Wall& wall : room) {
    const double ax = wall.from.x_m - ray.x_m, ay = wall.from.y_m - ray.y_m, dx = wall.to.x_m - wall.from.x_m,
                 dy = wall.to.y_m - wall.from.y_m, across = c * dy - s * dx;
    if (across == 0) continue;
    const double along_m = (ax * dy - ay * dx) / across, part = (ax * s - ay * c) / across;
    if (along_m > 0 && part >= 0 && part <= 1) nearest_m = std::min(nearest_m, along_m);
  }
  return nearest_m;
}

struct Scanner {
  calibration::LeverArm place;
  int beams = 360;
  double view_rad = 2 * std::numbers::pi;
  double noise_m = 0.01, lost = 0.02;
  double noise_of_range = 0;  // standard deviation over the range, beside noise_m
  double period_s = 0.2;
  bool spins = false;     // its beams are spread over the period
  bool mirrored = false;  // its scans say that the beams run the other way round
  double late_s = 0;      // of its stamps
  double range_max_m = 12;
};

struct Robot {
  calibration::WheelFactors actual;  // the nominal wheelbase is kNominalBase_m
  double slip_K_m = 2e-6;
};
inline constexpr double kNominalBase_m = 0.3;
inline constexpr calibration::WheelFactors kLoaded{1, 1, kNominalBase_m};

/// A velocity for some time, as the robot's odometry with the loaded factors takes it.
struct Leg {
  double v_mps, omega_radps, lasts_s;
};

/// The robot's way through the room in steps of a few milliseconds.
class SyntheticDrive {
 public:
  SyntheticDrive(Room room, const Robot& robot, const Scanner& scanner, std::uint64_t seed)
      : room_(std::move(room)), robot_(robot), scanner_(scanner), seed_(seed), random_(seed) {
    note();
  }

  void drive(const Leg& leg) {
    const double right_m = kStep_s * (leg.v_mps + leg.omega_radps * kNominalBase_m / 2),
                 left_m = kStep_s * (leg.v_mps - leg.omega_radps * kNominalBase_m / 2);
    for (int step = static_cast<int>(std::lround(leg.lasts_s / kStep_s)); step > 0; --step) {
      const double right_true_m = robot_.actual.c_r * right_m, left_true_m = robot_.actual.c_l * left_m;
      calibration::advance(pose_, right_true_m + slip(right_m), left_true_m + slip(left_m),
                           calibration::effective_wheelbase_m(right_true_m, left_true_m, robot_.actual));
      left_m_ += left_m;
      right_m_ += right_m;
      note();
    }
  }
  void drive(const std::vector<Leg>& legs) {
    for (const Leg& leg : legs) drive(leg);
  }

  /// Turns the robot within a tenth of a second, in which its wheels stand.
  calibration::Slip kick(double turn_rad) {
    constexpr int kSteps = 10;
    const double begin_s = wheels_.back().time_s;
    for (int step = 0; step < kSteps; ++step) {
      pose_.theta_rad += turn_rad / kSteps;
      note();
    }
    return {begin_s, wheels_.back().time_s, turn_rad};
  }

  const Pose2& pose() const { return pose_; }

  /// Its scans are made anew each time that they are read, with the same noise.
  ScannedDrive recorded() const {
    const auto self = std::make_shared<const SyntheticDrive>(*this);
    ScannedDrive drive{"synthetic", wheels_, 0, {}, true};
    drive.read_scans = [self](const ScanHandler& handle) { self->scan_all(handle); };
    return drive;
  }

  /// What the scanner sees in the pose at a time.
  Scan scan_at(double time_s, std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    Scan scan;
    const double step_rad = scanner_.view_rad / scanner_.beams, sense = scanner_.mirrored ? -1 : 1;
    scan.time_ns = std::llround(1e9 * (time_s + scanner_.late_s));
    scan.first_angle_rad = -sense * scanner_.view_rad / 2;
    scan.angle_step_rad = sense * step_rad;
    scan.beam_interval_s = scanner_.spins ? scanner_.period_s / scanner_.beams : 0;
    scan.range_min_m = 0.12;
    scan.range_max_m = scanner_.range_max_m;
    for (int beam = 0; beam < scanner_.beams; ++beam) {
      Pose2 ray = pose_at(time_s + beam * scan.beam_interval_s) * scanner_.place;
      ray.theta_rad += -scanner_.view_rad / 2 + beam * step_rad;
      const double distance = distance_m(room_, ray),
                   range_m = distance +
                             std::max(scanner_.noise_m, scanner_.noise_of_range * distance) * normal(random);
      scan.ranges_m.push_back(static_cast<float>(
          uniform(random) < scanner_.lost ? std::numeric_limits<double>::quiet_NaN() : range_m));
    }
    return scan;
  }

  /// Where the robot really was.
  Pose2 pose_at(double time_s) const {
    const double place = time_s / kStep_s;
    const auto i = static_cast<std::size_t>(std::min(place, static_cast<double>(poses_.size() - 1)));
    if (i + 1 >= poses_.size()) return poses_.back();
    const Twist2 step = poses_[i].between(poses_[i + 1]).log();
    const double part = place - static_cast<double>(i);
    return poses_[i] * Twist2{part * step.x_m, part * step.y_m, part * step.theta_rad}.exp();
  }

 private:
  static constexpr double kStep_s = 0.01;

  double slip(double wheel_m) { return std::sqrt(robot_.slip_K_m * std::abs(wheel_m)) * normal_(random_); }
  void note() {
    wheels_.push_back({kStep_s * static_cast<double>(wheels_.size()), left_m_, right_m_});
    poses_.push_back(pose_);
  }
  void scan_all(const ScanHandler& handle) const {
    std::mt19937_64 random(seed_ + 1);
    const double last_s = wheels_.back().time_s - scanner_.period_s;
    for (int i = 0; i * scanner_.period_s < last_s; ++i) handle(scan_at(i * scanner_.period_s, random));
  }

  Room room_;
  Robot robot_;
  Scanner scanner_;
  std::uint64_t seed_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose2 pose_;
  double left_m_ = 0, right_m_ = 0;
  std::vector<calibration::WheelSample> wheels_;
  std::vector<Pose2> poses_;
};

/// Squares and circles both ways round, some 25 m for each round, near the origin.
inline void drive_both_ways(SyntheticDrive& drive, int rounds) {
  constexpr double kQuarter = std::numbers::pi / 2;
  for (int round = 0; round < rounds; ++round)
    for (const double sense : {1.0, -1.0}) {
      for (int side = 0; side < 4; ++side) drive.drive({{0.5, 0, 3}, {0, sense * kQuarter, 1}});
      drive.drive({0.4, sense * 0.8, 2 * std::numbers::pi / 0.8});
    }
}

}  // namespace astro::lidar
