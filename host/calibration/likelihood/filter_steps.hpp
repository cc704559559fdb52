#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "host/calibration/motion/arc.hpp"
#include "host/calibration/likelihood/innovation.hpp"

/// What both filters along a drive do: move by an arc, expect a body, take the steps in order.
namespace astro::calibration::filter {

// Squares of Huber's thresholds: 99 % of chi-square with 2 and 3 degrees of freedom.
inline constexpr double kHuber2 = 9.210, kHuber3 = 11.345;
// What is left of a normal variance when no sample counts for more than the threshold (Huber's proposal 2):
// the mean of min(d^2, limit) over that of d^2. Bounded, for a variance, unlike a mean, would follow a few
// samples far out.
inline constexpr double kKept2 = 0.99, kKept3 = 0.99287;

/// A moment on the robot's clock, and how it moves with the clock's unknowns.
struct Moment {
  double time_s = 0, by_skew_s = 0;
};

/// One arc: where it leads, and what its end does when something changes.
struct Arc {
  double dx_m = 0, dy_m = 0;
  Eigen::Vector3d by_left = Eigen::Vector3d::Zero(),
                  by_right = Eigen::Vector3d::Zero();  // per metre of the wheel
  Eigen::Vector3d by_turn = Eigen::Vector3d::Zero();
  double turn_rad = 0;
};

inline Arc arc_of(double theta_rad, double left_m, double right_m, double b_m) {
  Arc arc;
  arc.turn_rad = (right_m - left_m) / b_m;
  const double half = arc.turn_rad / 2, centre_m = (left_m + right_m) / 2;
  const double chord = sinc(half);
  const double chord_slope =
      std::abs(half) < 1e-4 ? -half / 6 : (std::cos(half) - chord) / (2 * half);  // by the turn
  const double c = std::cos(theta_rad + half), s = std::sin(theta_rad + half);
  arc.dx_m = centre_m * chord * c;
  arc.dy_m = centre_m * chord * s;
  arc.by_turn = {centre_m * chord_slope * c - arc.dy_m / 2, centre_m * chord_slope * s + arc.dx_m / 2, 1};
  const Eigen::Vector3d by_centre(chord * c / 2, chord * s / 2, 0);
  arc.by_left = by_centre - arc.by_turn / b_m;
  arc.by_right = by_centre + arc.by_turn / b_m;
  return arc;
}

inline Eigen::Matrix3d transition(const Arc& arc) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 2) = -arc.dy_m;
  f(1, 2) = arc.dx_m;
  return f;
}

inline Eigen::Matrix3d slip_per_K(const Arc& arc, double left_m, double right_m) {
  return std::abs(left_m) * arc.by_left * arc.by_left.transpose() +
         std::abs(right_m) * arc.by_right * arc.by_right.transpose();
}

/// Where the tracked body should be, and how that moves with the state and the lever arm.
struct Expected {
  Eigen::Vector3d body;
  Eigen::Matrix3d by_state = Eigen::Matrix3d::Identity(), by_lever = Eigen::Matrix3d::Identity();
};

inline Expected expected_body(const Eigen::Vector3d& state, const Unknowns& u) {
  const double c = std::cos(state[2]), s = std::sin(state[2]);
  const double x = c * u[kLeverX] - s * u[kLeverY], y = s * u[kLeverX] + c * u[kLeverY];
  Expected expected;
  expected.body = {state[0] + x, state[1] + y, state[2] + u[kLeverYaw]};
  expected.by_state(0, 2) = -y;
  expected.by_state(1, 2) = x;
  expected.by_lever.topLeftCorner<2, 2>() << c, -s, s, c;
  return expected;
}

/// The moving parts of the filter, shared by its three uses. A user sees each arc, then each truth sample
/// that is to be looked at, with the motion that took most of the time since the one before.
template <class Use>
void follow(const PreparedRun& run, const Unknowns& u, const Looks& looks, Use& use) {
  const WheelPath wheels(run.source->wheels);
  const auto moment = [&](double truth_time_s) {
    const double by_skew_s = truth_time_s - run.clock_middle_s;
    return Moment{truth_time_s + u[kClockOffset] + u[kSkew] * by_skew_s, by_skew_s};
  };
  Moment from = moment(run.truth.front().time_s);
  WheelState at = wheels.at(from.time_s);
  std::array<double, 4> spent_s{};  // by Motion
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const Moment to = moment(run.truth[i].time_s);
    const int steps =
        i == 0 ? 0 : std::max(1, static_cast<int>(std::ceil((to.time_s - from.time_s) / kLongestStep_s)));
    const Moment begin = from;
    for (int step = 1; step <= steps; ++step) {
      const double part = static_cast<double>(step) / steps;
      const Moment next{begin.time_s + part * (to.time_s - begin.time_s),
                        begin.by_skew_s + part * (to.by_skew_s - begin.by_skew_s)};
      const WheelState then = wheels.at(next.time_s);
      use.move(from, at, next, then, run.motion[i]);
      from = next;
      at = then;
    }
    spent_s[static_cast<std::size_t>(run.motion[i])] += to.time_s - begin.time_s;
    if (static_cast<int>(i) % looks.stride != looks.first) continue;
    const auto most = std::max_element(spent_s.begin(), spent_s.end());
    use.look(run.truth[i], *most > 0 ? static_cast<Motion>(most - spent_s.begin()) : run.motion[i]);
    spent_s.fill(0);
  }
}

}  // namespace astro::calibration::filter
