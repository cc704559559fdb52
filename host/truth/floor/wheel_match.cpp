#include "host/truth/floor/wheel_match.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "host/calibration/motion/clock_search.hpp"

namespace astro::truth {
namespace {

/// Twice the largest distance from the mean: the same in every frame.
double extent_of(std::span<const FloorPoint> points) {
  double x = 0, y = 0, most = 0;
  for (const FloorPoint& point : points) {
    x += point.x_m / static_cast<double>(points.size());
    y += point.y_m / static_cast<double>(points.size());
  }
  for (const FloorPoint& point : points) most = std::max(most, std::hypot(point.x_m - x, point.y_m - y));
  return 2 * most;
}

/// Places that are a hundredth of the extent apart; all that is between is left out.
std::vector<FloorPoint> places_of(std::span<const FloorPoint> points) {
  const double step = extent_of(points) / 100;
  std::vector<FloorPoint> out;
  bool joined = true;
  for (const FloorPoint& point : points) {
    joined = joined && point.joined;
    const auto far = [&] {
      return std::hypot(point.x_m - out.back().x_m, point.y_m - out.back().y_m) >= step;
    };
    if (!out.empty() && !(step > 0 && far())) continue;
    out.push_back(point);
    out.back().joined = joined;
    joined = true;
  }
  return out;
}

/// How closely the path keeps to one direction in the body's frame, 0 to 1, for positions as they are (sign 1) or reflected
/// (-1). `fold` 2 counts forward and backward as the same.
double concentration(const std::vector<FloorPoint>& places, double sign, double fold) {
  std::complex<double> sum = 0;
  double length = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const FloorPoint &a = places[i - 1], &b = places[i];
    if (!b.joined) continue;
    const double step = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    const double direction_rad = std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
    sum += std::polar(step, fold * (sign * direction_rad - (a.theta_rad + b.theta_rad) / 2));
    length += step;
  }
  return length > 0 ? std::abs(sum) / length : 0;
}

/// The angle at a time; nothing outside of the samples or within a gap.
class AngleAt {
 public:
  explicit AngleAt(const Turning& turning) : turning_(turning) {}

  std::optional<double> operator()(double time_s) {
    while (next_ < turning_.size() && turning_[next_].time_s < time_s) ++next_;
    while (next_ > 0 && next_ <= turning_.size() && turning_[next_ - 1].time_s >= time_s) --next_;
    if (next_ == 0 || next_ >= turning_.size() || !turning_[next_].joined) return std::nullopt;
    const TurningSample &a = turning_[next_ - 1], &b = turning_[next_];
    return a.angle_rad + (b.angle_rad - a.angle_rad) * (time_s - a.time_s) / (b.time_s - a.time_s);
  }

 private:
  const Turning& turning_;
  std::size_t next_ = 0;
};

/// Left and right travel for a wheelbase that need only be roughly right.
constexpr double kWheelbase_m = 0.2;

std::vector<calibration::WheelSample> travel_of(std::span<const WheelMotion> wheels) {
  std::vector<calibration::WheelSample> out;
  double path_m = 0, turn_rad = 0;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (i > 0) {
      const double dt = wheels[i].time_s - wheels[i - 1].time_s;
      path_m += dt * (wheels[i].speed_mps + wheels[i - 1].speed_mps) / 2;
      turn_rad += dt * (wheels[i].yaw_rate_radps + wheels[i - 1].yaw_rate_radps) / 2;
    }
    out.push_back(
        {wheels[i].time_s, path_m - turn_rad * kWheelbase_m / 2, path_m + turn_rad * kWheelbase_m / 2});
  }
  return out;
}

/// The offset near `match` at which the turning agrees best.
double refined_offset(const ClockMatch& match, const Turning& own, const Turning& wheels) {
  constexpr double kStep_s = 0.01;
  constexpr int kSteps = 20;
  constexpr double kTurns = 0.8;  // less: the drive hardly turned
  const auto at = [&](int step) {
    return std::abs(
        turning_correlation(own, wheels, match.offset_s + step * kStep_s, match.skew, match.middle_s));
  };
  int best = 0;
  double most = at(0);
  for (int step = -kSteps; step <= kSteps; ++step) {
    const double value = at(step);
    if (value > most) {
      most = value;
      best = step;
    }
  }
  if (most < kTurns || std::abs(best) == kSteps) return match.offset_s;
  const double before = at(best - 1), after = at(best + 1), bend = before - 2 * most + after;
  const double part = bend < 0 ? (before - after) / (2 * bend) : 0;  // the top of the parabola through three
  return match.offset_s + kStep_s * (best + std::clamp(part, -0.5, 0.5));
}

}  // namespace

Turning path_turning(std::span<const FloorPoint> points, bool both_ways) {
  const std::vector<FloorPoint> places = places_of(points);
  const double same_rad = both_ways ? std::numbers::pi : 2 * std::numbers::pi;
  Turning out;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const FloorPoint &from = places[i - 1], &to = places[i];
    const double direction_rad = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
    const double before_rad = out.empty() ? direction_rad : out.back().angle_rad;
    const double change_rad = std::remainder(direction_rad - before_rad, same_rad);
    out.push_back({(from.time_s + to.time_s) / 2, before_rad + change_rad, from.joined && to.joined});
  }
  return out;
}

Turning heading_turning(std::span<const FloorPoint> points) {
  constexpr double kApart_s = 0.2;
  Turning out;
  bool joined = true;
  for (const FloorPoint& point : points) {
    joined = joined && point.joined;
    if (!out.empty() && point.time_s - out.back().time_s < kApart_s) continue;
    out.push_back({point.time_s, point.theta_rad, joined});
    joined = true;
  }
  return out;
}

double path_length(std::span<const FloorPoint> points) {
  const std::vector<FloorPoint> places = places_of(points);
  double length = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    length += std::hypot(places[i].x_m - places[i - 1].x_m, places[i].y_m - places[i - 1].y_m);
  return length;
}

double handedness(std::span<const FloorPoint> points) {
  if (points.empty() || std::isnan(points.front().theta_rad)) return 0;
  const std::vector<FloorPoint> places = places_of(points);
  const double forward = concentration(places, 1, 1) - concentration(places, -1, 1);
  const double both_ways = concentration(places, 1, 2) - concentration(places, -1, 2);
  return std::abs(forward) > std::abs(both_ways) ? forward : both_ways;
}

double turning_correlation(const Turning& a, const Turning& b, double shift_s, double skew, double middle_s) {
  AngleAt other(b);
  std::optional<double> before;
  double products = 0, squares_a = 0, squares_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto now = other(a[i].time_s + shift_s + skew * (a[i].time_s - middle_s));
    if (i > 0 && now && before && a[i].joined) {
      const double change_a = a[i].angle_rad - a[i - 1].angle_rad, change_b = *now - *before;
      products += change_a * change_b;
      squares_a += change_a * change_a;
      squares_b += change_b * change_b;
    }
    before = now;
  }
  return squares_a > 0 && squares_b > 0 ? products / std::sqrt(squares_a * squares_b) : 0;
}

Turning turning_of(std::span<const WheelMotion> wheels) {
  Turning out;
  double angle_rad = 0;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (i > 0)
      angle_rad += (wheels[i].time_s - wheels[i - 1].time_s) *
                   (wheels[i].yaw_rate_radps + wheels[i - 1].yaw_rate_radps) / 2;
    out.push_back({wheels[i].time_s, angle_rad});
  }
  return out;
}

double path_length(std::span<const WheelMotion> wheels) {
  double length = 0;
  for (std::size_t i = 1; i < wheels.size(); ++i)
    length += (wheels[i].time_s - wheels[i - 1].time_s) *
              (std::abs(wheels[i].speed_mps) + std::abs(wheels[i - 1].speed_mps)) / 2;
  return length;
}

std::optional<ClockMatch> match_clocks(std::span<const FloorPoint> points, double metres_per_unit,
                                       std::span<const WheelMotion> wheels) {
  if (points.size() < 10 || wheels.size() < 10) return std::nullopt;
  // A recording that is longer than a day has a wrong time in it, because no drive is that long.
  constexpr double kLongest_s = 86'400;
  if (points.back().time_s - points.front().time_s > kLongest_s ||
      wheels.back().time_s - wheels.front().time_s > kLongest_s)
    return std::nullopt;
  calibration::Trajectory run;
  run.wheels = travel_of(wheels);
  // This takes all points of 7 minutes at 240 Hz. Of an hour it takes 28 per second, which are enough for bins of 50 ms.
  constexpr std::size_t kMostPoints = 100'000;
  const std::size_t stride = points.size() / kMostPoints + 1;
  run.truth.reserve(points.size() / stride + 1);
  for (std::size_t i = 0; i < points.size(); i += stride)
    run.truth.push_back({points[i].time_s, metres_per_unit * points[i].x_m, metres_per_unit * points[i].y_m,
                         points[i].theta_rad});
  const calibration::ClockFit fit = calibration::search_clock(run, kWheelbase_m, std::nullopt);
  if (fit.correlation < 0.5 && fit.likeness < 0.5) return std::nullopt;
  const double middle_s = (points.front().time_s + points.back().time_s) / 2;
  ClockMatch match{fit.offset_s, fit.skew, middle_s, fit.correlation};
  if (!std::isnan(points.front().theta_rad))
    match.offset_s = refined_offset(match, heading_turning(points), turning_of(wheels));
  return match;
}

}  // namespace astro::truth
