#include "host/calibration/motion/motion_profile.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/calibration/motion/arc.hpp"
#include "host/calibration/motion/wheel_path.hpp"

namespace astro::calibration {
namespace {

constexpr double kLongestGap_s = 1;

}  // namespace

template <class Value>
void Stream<Value>::add(double time_s, Value value) {
  if (time_s_.empty()) {
    integral_.push_back({});
    gaps_.push_back(0);
  } else {
    const double span_s = time_s - time_s_.back();
    integral_.push_back(integral_.back() + span_s / 2 * (value_.back() + value));
    gaps_.push_back(gaps_.back() + (span_s > kLongestGap_s ? 1 : 0));
  }
  time_s_.push_back(time_s);
  value_.push_back(value);
}

template <class Value>
std::size_t Stream<Value>::interval_of(double time_s, std::size_t& last) const {
  return interval_near(last, std::span<const double>(time_s_), time_s, std::identity());
}

template <class Value>
Value Stream<Value>::value_at(std::size_t i, double time_s) const {
  const double span_s = time_s_[i + 1] - time_s_[i];
  return span_s > 0 ? value_[i] + (time_s - time_s_[i]) / span_s * (value_[i + 1] - value_[i]) : value_[i];
}

template <class Value>
Value Stream<Value>::integral_at(std::size_t i, double time_s) const {
  return integral_[i] + (time_s - time_s_[i]) / 2 * (value_[i] + value_at(i, time_s));
}

template <class Value>
std::optional<Value> Stream<Value>::rate(double time_s, const Window& window) const {
  const double reach_s = window.support_s() / 2, from_s = time_s - reach_s, to_s = time_s + reach_s;
  if (time_s_.size() < 2 || !(from_s >= time_s_.front() && to_s <= time_s_.back())) return {};
  const std::size_t from = interval_of(from_s, last_from_), to = interval_of(to_s, last_to_);
  if (gaps_[to + 1] != gaps_[from]) return {};
  if (!window.averaged) return (value_at(to, to_s) - value_at(from, from_s)) / reach_s / 2.0;
  const double width_s = 2 * window.half_s;
  const std::size_t middle = interval_of(time_s, last_middle_);
  return (integral_at(to, to_s) - 2.0 * integral_at(middle, time_s) + integral_at(from, from_s)) / width_s /
         width_s;
}

BodyPath::BodyPath(std::span<const BodySample> samples, bool headings) : headings_(headings) {
  double heading_rad = 0;
  std::optional<BodySample> first;
  for (const BodySample& sample : samples) {
    if (!std::isfinite(sample.x_m) || !std::isfinite(sample.y_m)) continue;
    if (headings && !std::isfinite(sample.theta_rad)) continue;
    if (!first) first = sample;
    // Values relative to the first one, because an integral of large numbers loses digits.
    position_m_.add(sample.time_s, {sample.x_m - first->x_m, sample.y_m - first->y_m});
    if (!headings) continue;
    heading_rad += wrapped_rad(sample.theta_rad - first->theta_rad - heading_rad);
    heading_rad_.add(sample.time_s, heading_rad);
  }
}

std::optional<Rate> BodyPath::rate(double time_s, const Window& window, double radius_m) const {
  const auto velocity = position_m_.rate(time_s, window);
  if (!velocity) return {};
  const auto turn = headings_ ? heading_rad_.rate(time_s, window) : 0;
  if (!turn) return {};
  return Rate{std::abs(*velocity), std::abs(*turn) * radius_m};
}

BodyPath wheel_body(std::span<const WheelSample> wheels, double wheelbase_m, double lever_m,
                    double beyond_s) {
  const WheelPath path(wheels);
  std::vector<BodySample> body;
  Pose2 robot;
  const double first_s = wheels.front().time_s - beyond_s, last_s = wheels.back().time_s + beyond_s;
  const double step_s = std::max(0.025, (last_s - first_s) / kMostSteps);
  const int steps = static_cast<int>(std::ceil((last_s - first_s) / step_s)) + 1;
  WheelState before = path.at(first_s);
  for (int i = 0; i <= steps; ++i) {
    const double time_s = first_s + i * step_s;
    const WheelState now = path.at(time_s);
    advance(robot, now.right_m - before.right_m, now.left_m - before.left_m, wheelbase_m);
    before = now;
    const Point2 at = robot * Point2{lever_m, 0};
    body.push_back({time_s, at.x_m, at.y_m, robot.theta_rad});
  }
  return BodyPath(body, true);
}

MotionProfile profile_of(const BodyPath& path, double from_s, double to_s, double bin_s, const Window& window,
                         double radius_m) {
  MotionProfile profile{from_s, bin_s, {}, {}, {}};
  for (int i = 0; from_s + i * bin_s <= to_s; ++i) {
    const std::optional<Rate> rate = path.rate(from_s + i * bin_s, window, radius_m);
    profile.speed_mps.push_back(rate ? rate->speed_mps : 0);
    profile.turn_mps.push_back(rate ? rate->turn_mps : 0);
    profile.known.push_back(rate.has_value());
  }
  return profile;
}

template class Stream<double>;
template class Stream<std::complex<double>>;

}  // namespace astro::calibration
