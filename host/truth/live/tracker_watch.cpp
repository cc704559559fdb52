#include "host/truth/live/tracker_watch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace astro::truth {
namespace {

constexpr std::size_t kMostSeen = 30'000;  // of the fastest tracker in the usual span

/// The scatter about the means of the first and the second half, and whether these means differ no more than
/// for a body that stands still.
struct Scatter {
  double deviation = 0;
  bool stands = false;
};

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double squares_of(std::span<const double> values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum;
}

Scatter scatter_of(std::span<const double> values) {
  constexpr double kMostErrors = 5;  // standard errors: a body that stands seems to move once in a million
  const auto first = values.first(values.size() / 2), second = values.subspan(values.size() / 2);
  const auto half = static_cast<double>(first.size());
  const double deviation = std::sqrt((squares_of(first) + squares_of(second)) / (2 * half - 2));
  const double moved = std::abs(mean_of(second) - mean_of(first));
  return {deviation, moved <= kMostErrors * deviation * std::sqrt(2 / half)};
}

}  // namespace

void TrackerWatch::take(const Sighting& sighting) {
  const bool repeated = std::exchange(last_, sighting.pose) == sighting.pose;
  Seen seen{sighting.stamp, std::nullopt};
  if (sighting.tracked && !repeated && is_possible(sighting.pose)) {
    seen.pose = on_floor(sighting.pose, up_);
    up_axis_.take(sighting.pose);
  }
  seen_.push_back(seen);
  if (seen_.size() > kMostSeen) seen_.pop_front();
}

std::optional<LiveNoise> TrackerWatch::rest() const {
  constexpr std::size_t kFewest = 20;
  constexpr double kGreatest_m = 0.01;  // no tracker has more noise; a robot that drives scatters more
  std::vector<double> x_m, y_m, theta_rad;
  for (const Seen& seen : seen_) {
    if (!seen.pose) continue;
    x_m.push_back(seen.pose->x_m);
    y_m.push_back(seen.pose->y_m);
    const double last = theta_rad.empty() ? seen.pose->theta_rad : theta_rad.back();
    theta_rad.push_back(last + wrapped_rad(seen.pose->theta_rad - last));
  }
  if (x_m.size() < kFewest) return std::nullopt;
  const Scatter x = scatter_of(x_m), y = scatter_of(y_m), theta = scatter_of(theta_rad);
  const double position_m = std::hypot(x.deviation, y.deviation) / std::numbers::sqrt2;
  if (!x.stands || !y.stands || !theta.stands || position_m > kGreatest_m) return std::nullopt;
  return LiveNoise{position_m, theta.deviation};
}

TrackerReport TrackerWatch::report(std::int64_t now_us) {
  while (!seen_.empty() && seen_.front().stamp.arrival_us < now_us - span_us_) seen_.pop_front();
  TrackerReport report;
  std::vector<std::int64_t> sent_us, arrived_us, with_body_us;
  for (const Seen& seen : seen_) {
    sent_us.push_back(seen.stamp.sender_us);
    arrived_us.push_back(seen.stamp.arrival_us);
    if (seen.pose) {
      with_body_us.push_back(seen.stamp.arrival_us);
      report.pose = seen.pose;
    }
  }
  report.poses = seen_.size();
  report.lost = seen_.size() - with_body_us.size();
  report.sender = regularity_of(sent_us);
  report.arrival = regularity_of(arrived_us);
  const bool by_sender = report.sender.period_s > 0 && report.sender.jitter_s <= report.arrival.jitter_s;
  const Regularity& used = by_sender ? report.sender : report.arrival;
  const std::vector<std::int64_t>& times_us = by_sender ? sent_us : arrived_us;
  if (used.period_s > 0) {
    const double frames = 1e-6 * static_cast<double>(times_us.back() - times_us.front()) / used.period_s + 1;
    report.rate_hz = 1 / used.period_s;
    report.missing =
        static_cast<std::size_t>(std::max(0.0, std::round(frames - static_cast<double>(times_us.size()))));
  }
  with_body_us.push_back(now_us);
  for (std::size_t i = 1; i < with_body_us.size(); ++i)
    report.longest_gap_s =
        std::max(report.longest_gap_s, 1e-6 * static_cast<double>(with_body_us[i] - with_body_us[i - 1]));
  report.rest = rest();
  report.objection = up_axis_.objection();
  return report;
}

}  // namespace astro::truth
