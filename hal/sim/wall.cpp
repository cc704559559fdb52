#include "hal/sim/wall.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/sim/noise.hpp"

namespace astro::sim {
namespace {

constexpr std::uint64_t kStream = 0x3A11, kPlayStream = 0x3A12;  // wheels use 0 and 1, the id 0x1D
constexpr double kAway_m = 0.03;       // from the wall, a front with play settles anew
constexpr double kGrain_m = 0.1;       // between the points at which the surface is drawn
constexpr double kSliding_Nspm = 500;  // below its limit friction is viscous, so that it has no jump at rest

}  // namespace

Wall::Wall(const WallConfig& config, const Body& body, std::uint64_t seed)
    : config_(config),
      body_(body),
      seed_(seed),
      out_x_(std::cos(config.out_rad)),
      out_y_(std::sin(config.out_rad)) {
  settle_front();
}

void Wall::settle_front() {
  front_turned_rad_ = body_.front_turned_rad;
  if (body_.front_play_rad > 0)
    front_turned_rad_ += body_.front_play_rad * gauss(seed_, kPlayStream, touches_);
  ++touches_;
  touched_ = false;
}

// Of the surface over the even plane: linear between points of white noise.
double Wall::height_m(double along_m) const {
  if (config_.unevenness_m == 0) return 0;
  const double cell = std::floor(along_m / kGrain_m), part = along_m / kGrain_m - cell;
  const auto index = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell));
  return config_.unevenness_m *
         ((1 - part) * gauss(seed_, kStream, index) + part * gauss(seed_, kStream, index + 1));
}

double Wall::gap_m(double x_m, double y_m) const {
  const double dx_m = x_m - config_.x_m, dy_m = y_m - config_.y_m;
  return dx_m * out_x_ + dy_m * out_y_ - height_m(dy_m * out_x_ - dx_m * out_y_);
}

WallForce Wall::force(const Pose& pose, double v_mps, double omega_radps) {
  WallForce sum;
  double nearest_m = kAway_m;
  const double reach_m = std::hypot(std::max(body_.ahead_m, body_.behind_m), body_.width_m / 2) + 0.1;
  if ((pose.x_m - config_.x_m) * out_x_ + (pose.y_m - config_.y_m) * out_y_ > reach_m) return sum;
  const double c = std::cos(pose.theta_rad), s = std::sin(pose.theta_rad);
  for (const double ahead_m : {body_.ahead_m, -body_.behind_m}) {
    for (const double left_m : {body_.width_m / 2, -body_.width_m / 2}) {
      // A front that is not mounted square to the axle is longer on one side.
      const double x_m = ahead_m - std::tan(front_turned_rad_) * (ahead_m > 0 ? left_m : 0);
      const double arm_x_m = c * x_m - s * left_m, arm_y_m = s * x_m + c * left_m;
      const double depth_m = -gap_m(pose.x_m + arm_x_m, pose.y_m + arm_y_m);
      nearest_m = std::min(nearest_m, -depth_m);
      if (depth_m <= 0) continue;
      touched_ = true;
      const double x_mps = v_mps * c - omega_radps * arm_y_m, y_mps = v_mps * s + omega_radps * arm_x_m;
      const double into_mps = -(x_mps * out_x_ + y_mps * out_y_), along_mps = y_mps * out_x_ - x_mps * out_y_;
      const double across_N =
          std::max(0.0, config_.stiffness_Npm * depth_m + config_.damping_Nspm * into_mps);
      const double along_N = -std::copysign(
          std::min(kSliding_Nspm * std::abs(along_mps), config_.friction * across_N), along_mps);
      const double x_N = across_N * out_x_ - along_N * out_y_, y_N = across_N * out_y_ + along_N * out_x_;
      sum.forward_N += x_N * c + y_N * s;
      sum.turning_Nm += arm_x_m * y_N - arm_y_m * x_N;
      sum.pressing_N += across_N;
    }
  }
  if (touched_ && nearest_m >= kAway_m) settle_front();
  return sum;
}

double Wall::gap_at_m(const Pose& pose, double ahead_m) const {
  return gap_m(pose.x_m + ahead_m * std::cos(pose.theta_rad), pose.y_m + ahead_m * std::sin(pose.theta_rad));
}

double Wall::front_gap_m(const Pose& pose) const { return gap_at_m(pose, body_.ahead_m); }
double Wall::rear_gap_m(const Pose& pose) const { return gap_at_m(pose, -body_.behind_m); }

double Wall::flush_heading_rad() const { return config_.out_rad + std::numbers::pi - front_turned_rad_; }

}  // namespace astro::sim
