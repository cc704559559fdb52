#include "host/calibration/likelihood/moves.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibration/motion/arc.hpp"
#include "host/calibration/motion/wheel_path.hpp"

namespace astro::calibration {
namespace {

/// A moment on the robot's clock, and its derivative by the skew of the clocks.
struct Moment {
  double time_s = 0, by_skew_s = 0;
};

/// sin(a) / a and its slope. Arcs are short: the series is exact to rounding there, and the slope's closed form is not.
struct Sinc {
  double value, slope;
};

Sinc sinc_with_slope(double a) {
  const double q = a * a;
  if (q < 0.0025)
    return {1 - q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72))),
            -a / 3 * (1 - q / 10 * (1 - q / 28 * (1 - q / 54 * (1 - q / 88))))};
  const double value = std::sin(a) / a;
  return {value, (std::cos(a) - value) / a};
}

Vector3 sum(double f, const Vector3& a, double g, const Vector3& b) {
  return {f * a[0] + g * b[0], f * a[1] + g * b[1], f * a[2] + g * b[2]};
}

Vector3 scaled(double f, const Vector3& v) { return {f * v[0], f * v[1], f * v[2]}; }

/// Adds f v v'.
void add_square(Symmetric3& sum, double f, const Vector3& v) {
  sum += Symmetric3{f * v[0] * v[0], f * v[0] * v[1], f * v[0] * v[2],
                    f * v[1] * v[1], f * v[1] * v[2], f * v[2] * v[2]};
}

/// The turn of an arc and its derivatives by the travels of the wheels, b and e.
struct Turn {
  double rad, by_right, by_left, by_b, by_e;
};

Turn turn_of(double right_m, double left_m, double b_m, double e, double kappa0) {
  const double difference_m = right_m - left_m, sum_m = right_m + left_m;
  const double along = kappa0 * std::abs(sum_m) / 2, across = std::abs(difference_m);
  const double g = along / (along + across), about_m = b_m * (1 + e * g), rad = difference_m / about_m;
  // g grows with the sum and falls with the difference.
  const double squared = (along + across) * (along + across);
  const double g_by_sum = std::copysign(kappa0 / 2 * across / squared, sum_m);
  const double g_by_difference = -std::copysign(along / squared, difference_m);
  const double by_g = -rad * e * b_m / about_m;
  return {rad, 1 / about_m + by_g * (g_by_sum + g_by_difference),
          -1 / about_m + by_g * (g_by_sum - g_by_difference), -rad / b_m, -rad * g * b_m / about_m};
}

Move move_between(const Moment& from, const WheelState& was, const Moment& to, const WheelState& is,
                  const Unknowns& u, double kappa0) {
  const double left_m = is.left_m - was.left_m, right_m = is.right_m - was.right_m;
  const double by_left_m = u[kCLeft] * left_m, by_right_m = u[kCRight] * right_m;
  const double centre_m = (by_left_m + by_right_m) / 2;
  const Turn turn = turn_of(by_right_m, by_left_m, u[kB], u[kE], kappa0);
  Move move;
  move.turn_rad = turn.rad;
  const Sinc chord = sinc_with_slope(move.turn_rad / 2);
  move.chord_m = centre_m * chord.value;
  const double half_rad = move.turn_rad / 2;
  move.half_sine = half_rad * chord.value;
  move.half_cosine =
      std::abs(half_rad) < 1 ? std::sqrt(1 - move.half_sine * move.half_sine) : std::cos(half_rad);
  const Vector3 by_turn{centre_m * chord.slope / 2, move.chord_m / 2, 1};
  const Vector3 by_centre{chord.value, 0, 0};
  const Vector3 by_left = sum(0.5, by_centre, turn.by_left, by_turn);
  const Vector3 by_right = sum(0.5, by_centre, turn.by_right, by_turn);
  add_square(move.slip_per_K, std::abs(left_m), by_left);
  add_square(move.slip_per_K, std::abs(right_m), by_right);
  const auto velocity = [&](const WheelState& wheels) {
    return sum(u[kCLeft] * wheels.left_mps, by_left, u[kCRight] * wheels.right_mps, by_right);
  };
  const Vector3 at_start = velocity(was), at_end = velocity(is);
  move.by = {scaled(right_m, by_right),
             scaled(left_m, by_left),
             scaled(turn.by_b, by_turn),
             scaled(turn.by_e, by_turn),
             sum(to.by_skew_s, at_end, -from.by_skew_s, at_start),
             sum(1, at_end, -1, at_start)};
  return move;
}

}  // namespace

Moves::Moves(const PreparedRun& run, const Unknowns& u, double kappa0) : run_(&run), unknowns_(u) {
  const WheelPath wheels(run.source->wheels);
  const auto moment = [&](double truth_time_s) {
    const double since_middle_s = truth_time_s - run.clock_middle_s;
    return Moment{truth_time_s + u[kClockOffset] + u[kSkew] * since_middle_s, since_middle_s};
  };
  moves_.reserve(run.truth.size());
  Moment from = moment(run.truth.front().time_s);
  WheelState was = wheels.at(from.time_s);
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const Moment begin = from, end = moment(run.truth[i].time_s);
    const double duration_s = end.time_s - begin.time_s;
    const int steps = i == 0 ? 0 : std::max(1, static_cast<int>(std::ceil(duration_s / kLongestStep_s)));
    for (int step = 1; step <= steps; ++step) {
      const double part = static_cast<double>(step) / steps;
      const Moment to{begin.time_s + part * duration_s,
                      begin.by_skew_s + part * (end.by_skew_s - begin.by_skew_s)};
      const WheelState is = wheels.at(to.time_s);
      if (is.left_m != was.left_m || is.right_m != was.right_m)
        moves_.push_back(move_between(from, was, to, is, u, kappa0));
      from = to;
      was = is;
    }
    ends_.push_back(moves_.size());
    durations_s_.push_back(duration_s);
  }
}

}  // namespace astro::calibration
