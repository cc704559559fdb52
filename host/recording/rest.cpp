#include "host/recording/rest.hpp"

#include <algorithm>
#include <limits>

#include "common/fixed/wrapping.hpp"

namespace astro::recording {
namespace {

bool is_still(const OdometrySample& a, const OdometrySample& b) {
  const std::int32_t left = wrapping_difference(b.left_counts, a.left_counts);
  const std::int32_t right = wrapping_difference(b.right_counts, a.right_counts);
  return left >= -kStillCounts && left <= kStillCounts && right >= -kStillCounts && right <= kStillCounts;
}

/// Mean of poses; headings are averaged as differences from the first one, so that neither wraps nor whole
/// turns matter.
class PoseMean {
 public:
  void add(double x_m, double y_m, double theta_rad) {
    x_sum_ += x_m;
    y_sum_ += y_m;
    ++count_;
    if (!std::isfinite(theta_rad)) return;
    if (heading_count_ == 0) first_rad_ = theta_rad;
    turn_sum_ += wrapped_rad(theta_rad - first_rad_);
    ++heading_count_;
  }
  std::optional<Pose2> mean() const {
    if (count_ == 0) return std::nullopt;
    return Pose2{x_sum_ / count_, y_sum_ / count_, first_rad_ + turn_sum_ / heading_count_};
  }

 private:
  double x_sum_ = 0, y_sum_ = 0, turn_sum_ = 0;
  double first_rad_ = std::numeric_limits<double>::quiet_NaN();
  int count_ = 0, heading_count_ = 0;
};

template <class Sample>
bool counts_within(const Sample& sample, std::int64_t from_us, std::int64_t to_us) {
  return sample.time_us >= from_us && sample.time_us <= to_us && std::isfinite(sample.x_m) &&
         std::isfinite(sample.y_m);
}

std::optional<Rest> average(const Run& run, std::int64_t from_us, std::int64_t to_us) {
  PoseMean odometry;
  PoseMean truth;
  for (const OdometrySample& sample : run.odometry) {
    if (counts_within(sample, from_us, to_us)) odometry.add(sample.x_m, sample.y_m, sample.theta_rad);
  }
  for (const TruthSample& sample : run.truth) {
    if (sample.valid && counts_within(sample, from_us, to_us)) {
      truth.add(sample.x_m, sample.y_m, sample.theta_rad);
    }
  }
  const auto odometry_mean = odometry.mean();
  if (!odometry_mean) return std::nullopt;
  return Rest{from_us, to_us, *odometry_mean, truth.mean()};
}

/// Time of the last sample, counted from `first`, before a wheel leaves its position in `first`.
template <class Iterator>
std::int64_t last_still_us(Iterator first, Iterator last) {
  const auto moves = std::find_if(first, last, [&](const auto& sample) { return !is_still(*first, sample); });
  return std::prev(moves)->time_us;
}

}  // namespace

std::optional<Rest> rest_at_start(const Run& run) {
  if (run.odometry.empty()) return std::nullopt;
  const std::int64_t from_us = run.odometry.front().time_us;
  const std::int64_t to_us = last_still_us(run.odometry.begin(), run.odometry.end());
  if (to_us - from_us < kShortestRestUs) return std::nullopt;
  return average(run, from_us, to_us - kSettlingUs);
}

std::optional<Rest> rest_at_end(const Run& run) {
  if (run.odometry.empty()) return std::nullopt;
  const std::int64_t to_us = run.odometry.back().time_us;
  const std::int64_t from_us = last_still_us(run.odometry.rbegin(), run.odometry.rend());
  if (to_us - from_us < kShortestRestUs) return std::nullopt;
  return average(run, from_us + kSettlingUs, to_us);
}

}  // namespace astro::recording
