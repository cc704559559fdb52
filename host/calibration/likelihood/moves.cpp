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
  const double all = along + across, g = all > 0 ? along / all : 1;
  const double per_m = 1 / (b_m * (1 + e * g)), rad = difference_m * per_m;
  Turn turn{rad, per_m, -per_m, -rad / b_m, -rad * g * b_m * per_m};
  if (e == 0 || all == 0) return turn;
  // g grows with the sum and falls with the difference.
  const double g_by_sum = std::copysign(kappa0 / 2 * across / (all * all), sum_m);
  const double g_by_difference = -std::copysign(along / (all * all), difference_m);
  const double by_g = -rad * e * b_m * per_m;
  turn.by_right += by_g * (g_by_sum + g_by_difference);
  turn.by_left += by_g * (g_by_sum - g_by_difference);
  return turn;
}

/// v in the frame of an arc's chord, given in the robot's frame at its beginning; cosine and sine of half the turn.
Vector3 turned(const Vector3& v, double c, double s) {
  return {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
}

/// What the wheels travel in a step.
struct Travel {
  double right_m, left_m;
};

/// `steady`: the travel without the rounding of the counts, for the derivative by e.
Move move_between(const Moment& from, const WheelState& was, const Moment& to, const WheelState& is,
                  const Travel& steady, const Unknowns& u, double kappa0) {
  const double left_m = is.left_m - was.left_m, right_m = is.right_m - was.right_m;
  const double by_left_m = u[kCLeft] * left_m, by_right_m = u[kCRight] * right_m;
  const double centre_m = (by_left_m + by_right_m) / 2;
  const Turn turn = turn_of(by_right_m, by_left_m, u[kB], u[kE], kappa0);
  const double half_rad = turn.rad / 2;
  const Sinc chord = sinc_with_slope(half_rad);
  const double chord_m = centre_m * chord.value;
  const double s = half_rad * chord.value;
  const double c = std::abs(half_rad) < 1 ? std::sqrt(1 - s * s) : std::cos(half_rad);
  // An arc's derivatives are simple along its chord, which has the heading of the arc's middle.
  const Vector3 by_turn = turned({centre_m * chord.slope / 2, chord_m / 2, 1}, c, s);
  const Vector3 by_centre{c * chord.value, s * chord.value, 0};
  const Vector3 by_left = sum(0.5, by_centre, turn.by_left, by_turn);
  const Vector3 by_right = sum(0.5, by_centre, turn.by_right, by_turn);
  Move move;
  move.x_m = chord_m * c;
  move.y_m = chord_m * s;
  move.turn_rad = turn.rad;
  move.cosine = c * c - s * s;
  move.sine = 2 * c * s;
  add_square(move.slip_per_K, std::abs(left_m), by_left);
  add_square(move.slip_per_K, std::abs(right_m), by_right);
  const auto velocity = [&](const WheelState& wheels) {
    return sum(u[kCLeft] * wheels.left_mps, by_left, u[kCRight] * wheels.right_mps, by_right);
  };
  const Vector3 at_start = velocity(was), at_end = velocity(is);
  move.by = {
      scaled(right_m, by_right),
      scaled(left_m, by_left),
      scaled(turn.by_b, by_turn),
      scaled(turn_of(u[kCRight] * steady.right_m, u[kCLeft] * steady.left_m, u[kB], u[kE], kappa0).by_e,
             by_turn),
      sum(to.by_skew_s, at_end, -from.by_skew_s, at_start),
      sum(1, at_end, -1, at_start)};
  return move;
}

/// Travels at the mean speed from a little before a step to a little after it. Counts are whole numbers, and what is rounded at the
/// ends of a step is in its own travel twice over. On a line that makes most of a turn, so its product with the innovation would
/// not vanish on average, and e would come out too large. The rounding further away is independent of that.
class SteadyTravel {
 public:
  explicit SteadyTravel(std::span<const WheelSample> samples)
      : before_(samples),
        after_(samples),
        margin_s_(2 * (samples.back().time_s - samples.front().time_s) /
                  static_cast<double>(samples.size() - 1)) {}

  Travel between(double from_s, double to_s) const {
    const WheelState was = before_.at(from_s - margin_s_), is = after_.at(to_s + margin_s_);
    const double part = (to_s - from_s) / (to_s - from_s + 2 * margin_s_);
    return {part * (is.right_m - was.right_m), part * (is.left_m - was.left_m)};
  }

 private:
  WheelPath before_, after_;  // two, because each remembers where it was asked last
  double margin_s_;
};

void add(Leg& leg, const Move& move) {
  leg.move = leg.moved ? joined(leg.move, move) : move;
  leg.moved = true;
}

}  // namespace

Move joined(const Move& first, const Move& second) {
  const double c = first.cosine, s = first.sine;
  const double x_m = c * second.x_m - s * second.y_m, y_m = s * second.x_m + c * second.y_m;
  Move both;
  both.x_m = first.x_m + x_m;
  both.y_m = first.y_m + y_m;
  both.turn_rad = first.turn_rad + second.turn_rad;
  both.cosine = c * second.cosine - s * second.sine;
  both.sine = s * second.cosine + c * second.sine;
  both.slip_per_K = sheared(first.slip_per_K, -y_m, x_m) + rotated(second.slip_per_K, c, s);
  for (std::size_t i = 0; i < both.by.size(); ++i) {
    const Vector3& a = first.by[i];
    const Vector3 b = turned(second.by[i], c, s);
    both.by[i] = {a[0] - y_m * a[2] + b[0], a[1] + x_m * a[2] + b[1], a[2] + b[2]};
  }
  return both;
}

Move move_of(double nominal_right_m, double nominal_left_m, const WheelFactors& factors) {
  Unknowns unknowns = Unknowns::Zero();
  unknowns.head<kFactors>() << factors.c_r, factors.c_l, factors.b_m, factors.e;
  WheelState end;
  end.right_m = nominal_right_m;
  end.left_m = nominal_left_m;
  return move_between({}, {}, {}, end, {nominal_right_m, nominal_left_m}, unknowns, factors.kappa0);
}

Moves::Moves(const PreparedRun& run, const Unknowns& unknowns, double kappa0,
             std::vector<SampleSelection> selections)
    : run_(&run), kappa0_(kappa0), selections_(std::move(selections)) {
  if (selections_.empty()) legs_.reserve(run.truth.size());
  change(unknowns);
}

bool Moves::takes(std::size_t sample) const {
  return selections_.empty() ||
         std::any_of(selections_.begin(), selections_.end(), [&](const SampleSelection& selection) {
           return selection.takes(run_->knots_m, sample);
         });
}

void Moves::change(const Unknowns& unknowns) {
  unknowns_ = unknowns;
  legs_.clear();  // keeps its memory, which for every truth sample of a long run is megabytes
  const Unknowns& u = unknowns_;
  const PreparedRun& run = *run_;
  const WheelPath wheels(run.source->wheels);
  const SteadyTravel steady(run.source->wheels);
  const auto moment = [&](double truth_time_s) {
    const double since_middle_s = truth_time_s - run.clock_middle_s;
    return Moment{truth_time_s + u[kClockOffset] + u[kSkew] * since_middle_s, since_middle_s};
  };
  Leg leg;
  Moment from = moment(run.truth.front().time_s);
  WheelState was = wheels.at(from.time_s);
  auto gap = run.gaps.begin();
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
        add(leg, move_between(from, was, to, is, steady.between(from.time_s, to.time_s), u, kappa0_));
      from = to;
      was = is;
    }
    for (; gap != run.gaps.end() && gap->end_s < end.time_s + kLongestStep_s; ++gap)
      if (i > 0) {
        leg.unknown_m2 += gap->unknown_m2;
        leg.unknown_rad2 += gap->unknown_rad2;
      }
    leg.spent_s[static_cast<std::size_t>(run.motion[i])] += duration_s;
    if (!takes(i)) continue;
    leg.sample = i;
    legs_.push_back(leg);
    leg = {};
  }
}

Moves Moves::joined(const SampleSelection& selection) const {
  Moves out(*this, {selection}, Empty());
  Leg leg;
  for (const Leg& part : legs_) {
    if (part.moved) add(leg, part.move);
    leg.unknown_m2 += part.unknown_m2;
    leg.unknown_rad2 += part.unknown_rad2;
    for (std::size_t motion = 0; motion < leg.spent_s.size(); ++motion)
      leg.spent_s[motion] += part.spent_s[motion];
    if (!out.takes(part.sample)) continue;
    leg.sample = part.sample;
    out.legs_.push_back(leg);
    leg = {};
  }
  return out;
}

}  // namespace astro::calibration
