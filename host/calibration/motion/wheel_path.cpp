#include "host/calibration/motion/wheel_path.hpp"

#include <algorithm>

namespace astro::calibration {
namespace {

struct Value {
  double travel_m, rate_mps;
};

// Cubic Hermite over an interval of `span_s`, from its ends' values and rates.
Value hermite(double from_m, double to_m, double from_mps, double to_mps, double span_s, double s) {
  const double rise = (to_m - from_m) / span_s;
  const double a = from_mps + to_mps - 2 * rise, b = 3 * rise - 2 * from_mps - to_mps;
  return {from_m + span_s * s * (from_mps + s * (b + s * a)), from_mps + s * (2 * b + s * 3 * a)};
}

}  // namespace

std::size_t WheelPath::interval_of(double time_s) const {
  const auto holds = [&](std::size_t i) {
    return i + 1 < samples_.size() && samples_[i].time_s <= time_s && time_s < samples_[i + 1].time_s;
  };
  for (std::size_t i = last_; i < last_ + 4; ++i)
    if (holds(i)) return last_ = i;
  const auto next =
      std::upper_bound(samples_.begin() + 1, samples_.end() - 1, time_s,
                       [](double time, const WheelSample& sample) { return time < sample.time_s; });
  return last_ = static_cast<std::size_t>(next - samples_.begin()) - 1;
}

WheelState WheelPath::at(double time_s) const {
  const WheelSample &first = samples_.front(), &end = samples_.back();
  if (time_s <= first.time_s) return {first.left_m, first.right_m, 0, 0};
  if (time_s >= end.time_s) return {end.left_m, end.right_m, 0, 0};
  const std::size_t i = interval_of(time_s);
  const WheelSample &a = samples_[i], &b = samples_[i + 1];
  const WheelSample& before = samples_[i > 0 ? i - 1 : i];
  const WheelSample& after = samples_[i + 2 < samples_.size() ? i + 2 : i + 1];
  const double span_s = b.time_s - a.time_s, s = (time_s - a.time_s) / span_s;
  const double in_s = b.time_s - before.time_s, out_s = after.time_s - a.time_s;
  const Value left = hermite(a.left_m, b.left_m, (b.left_m - before.left_m) / in_s,
                             (after.left_m - a.left_m) / out_s, span_s, s);
  const Value right = hermite(a.right_m, b.right_m, (b.right_m - before.right_m) / in_s,
                              (after.right_m - a.right_m) / out_s, span_s, s);
  return {left.travel_m, right.travel_m, left.rate_mps, right.rate_mps};
}

}  // namespace astro::calibration
