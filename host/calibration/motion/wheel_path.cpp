#include "host/calibration/motion/wheel_path.hpp"

namespace astro::calibration {
namespace {

struct Value {
  double travel_m, rate_mps;
};

// Cubic Hermite over an interval of `span_s`, from its ends' values and rates; `rise` is the mean rate in between.
Value hermite(double from_m, double rise, double from_mps, double to_mps, double span_s, double s) {
  const double a = from_mps + to_mps - 2 * rise, b = 3 * rise - 2 * from_mps - to_mps;
  return {from_m + span_s * s * (from_mps + s * (b + s * a)), from_mps + s * (2 * b + s * 3 * a)};
}

}  // namespace

std::size_t WheelPath::interval_of(double time_s) const {
  return interval_near(last_, samples_, time_s, [](const WheelSample& sample) { return sample.time_s; });
}

WheelState WheelPath::at(double time_s) const {
  const WheelSample &first = samples_.front(), &end = samples_.back();
  if (time_s <= first.time_s) return {first.left_m, first.right_m, 0, 0};
  if (time_s >= end.time_s) return {end.left_m, end.right_m, 0, 0};
  const std::size_t i = interval_of(time_s);
  const WheelSample &a = samples_[i], &b = samples_[i + 1];
  const WheelSample& before = samples_[i > 0 ? i - 1 : i];
  const WheelSample& after = samples_[i + 2 < samples_.size() ? i + 2 : i + 1];
  const double span_s = b.time_s - a.time_s;
  // Reciprocals, because a fit calls this a million times, and a division costs as much as the rest of a
  // wheel's cubic.
  const double per_span = 1 / span_s, per_in = 1 / (b.time_s - before.time_s),
               per_out = 1 / (after.time_s - a.time_s);
  const double s = per_span * (time_s - a.time_s);
  const auto of = [&](double WheelSample::*travel_m) {
    return hermite(a.*travel_m, per_span * (b.*travel_m - a.*travel_m),
                   per_in * (b.*travel_m - before.*travel_m), per_out * (after.*travel_m - a.*travel_m),
                   span_s, s);
  };
  const Value left = of(&WheelSample::left_m), right = of(&WheelSample::right_m);
  return {left.travel_m, right.travel_m, left.rate_mps, right.rate_mps};
}

}  // namespace astro::calibration
