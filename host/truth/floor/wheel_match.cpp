#include "host/truth/floor/wheel_match.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

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

using Complex = std::complex<double>;

/// Where the robot is by its wheels, from (0, 0) with heading 0 at the first sample.
class WayOfWheels {
 public:
  explicit WayOfWheels(std::span<const WheelMotion> wheels) : wheels_(wheels) {}

  /// Moves on to a time, which must not fall; false outside of the samples.
  bool go_to(double time_s) {
    if (wheels_.size() < 2 || time_s < wheels_.front().time_s || time_s > wheels_.back().time_s) return false;
    for (; next_ < wheels_.size() && wheels_[next_].time_s < time_s; ++next_) step_to(wheels_[next_].time_s);
    step_to(time_s);
    return true;
  }
  Complex at() const { return at_; }
  double heading_rad() const { return heading_rad_; }
  double turned_rad() const { return turned_rad_; }

 private:
  void step_to(double time_s) {
    const double from_s = std::exchange(time_s_, std::max(time_s, time_s_));
    if (from_s == -HUGE_VAL) return;
    const WheelMotion &a = wheels_[std::max<std::size_t>(next_, 1) - 1],
                      &b = wheels_[std::min(next_, wheels_.size() - 1)];
    const double span_s = time_s_ - from_s, turn_rad = span_s * (a.yaw_rate_radps + b.yaw_rate_radps) / 2;
    at_ += std::polar(span_s * (a.speed_mps + b.speed_mps) / 2, heading_rad_ + turn_rad / 2);
    heading_rad_ += turn_rad;
    turned_rad_ += std::abs(turn_rad);
  }

  std::span<const WheelMotion> wheels_;
  std::size_t next_ = 0;
  double time_s_ = -HUGE_VAL, heading_rad_ = 0, turned_rad_ = 0;
  Complex at_;
};

/// How much of positions z, and of their mirror image, the ways t + r (q + l exp(i phi)) of all points l on the robot leave
/// unexplained: linear least squares in t, r and r l.
class ShapeMatch {
 public:
  void take(const WayOfWheels& robot, Complex z) {
    if (count_ == 0) origin_ = z, begin_ = robot.at();
    z -= origin_;
    const Eigen::Vector3cd row(1, robot.at() - begin_, std::polar(1.0, robot.heading_rad()));
    normal_ += row.conjugate() * row.transpose();
    right_side_.col(0) += row.conjugate() * z;
    right_side_.col(1) += row.conjugate() * std::conj(z);
    squares_m2_ += std::norm(z);
    ++count_;
  }
  double spread_m2() const { return count_ > 0 ? squares_m2_ - std::norm(right_side_(0, 0)) / count_ : 0; }
  Eigen::Array2d unexplained_m2() const {
    if (count_ < kFewest) return {0, 0};
    // A point far from the robot would explain any two lines. This prior hardly holds back one on it.
    constexpr double kUsualLever_m = 0.3, kPrior = 0.05;
    const double way_m2 = normal_(1, 1).real() - std::norm(normal_(0, 1)) / count_;
    Eigen::Matrix3cd normal = normal_ + 1e-9 * normal_.trace() * Eigen::Matrix3cd::Identity();
    normal(2, 2) += kPrior * way_m2 / (kUsualLever_m * kUsualLever_m);
    const Eigen::Matrix<Complex, 3, 2> found = normal.ldlt().solve(right_side_);
    const auto explained = [&](int side) { return right_side_.col(side).dot(found.col(side)).real(); };
    return {std::max(0.0, squares_m2_ - explained(0)), std::max(0.0, squares_m2_ - explained(1))};
  }

 private:
  static constexpr int kFewest = 5;

  Complex origin_, begin_;
  Eigen::Matrix3cd normal_ = Eigen::Matrix3cd::Zero();
  Eigen::Matrix<Complex, 3, 2> right_side_ = Eigen::Matrix<Complex, 3, 2>::Zero();
  double squares_m2_ = 0;
  int count_ = 0;
};

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

double handedness(std::span<const FloorPoint> points, std::span<const WheelMotion> wheels,
                  const ClockMatch& clock) {
  constexpr double kStretch_rad = std::numbers::pi;  // longer ones a wrong wheelbase would bend
  constexpr double kStraight = 1e-3;                 // of the spread: what sways about a line
  WayOfWheels robot(wheels);
  ShapeMatch stretch;
  Eigen::Array2d unexplained_m2(0, 0);
  double spread_m2 = 0, begin_rad = 0;
  const auto finish = [&] {
    unexplained_m2 += stretch.unexplained_m2();
    spread_m2 += stretch.spread_m2();
    stretch = {};
    begin_rad = robot.turned_rad();
  };
  for (const FloorPoint& point : points) {
    if (!robot.go_to(point.time_s + clock.offset_s + clock.skew * (point.time_s - clock.middle_s))) continue;
    stretch.take(robot, {point.x_m, point.y_m});
    if (robot.turned_rad() - begin_rad > kStretch_rad) finish();
  }
  finish();
  const double all_m2 = unexplained_m2.sum() + kStraight * spread_m2;
  return all_m2 > 0 ? (unexplained_m2[1] - unexplained_m2[0]) / all_m2 : 0;
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
