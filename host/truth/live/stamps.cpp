#include "host/truth/live/stamps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "host/base/order_statistics.hpp"

namespace astro::truth {
namespace {

constexpr std::int64_t kJump_us =
    100'000;  // more than a network changes the order of datagrams, or a clock is slewed
constexpr std::int64_t kMostDrift =
    1'000;                               // 1 / that is the greatest drift between two clocks that is followed
constexpr double kUsualJitter_s = 1e-3;  // of stamps in whole milliseconds

std::vector<double> intervals_of(std::span<const std::int64_t> times_us) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times_us.size(); ++i)
    intervals.push_back(static_cast<double>(times_us[i] - times_us[i - 1]));
  return intervals;
}

double periods_in(double interval, double period) { return std::max(1.0, std::round(interval / period)); }

/// The mean interval, if frames come in bursts. Otherwise missing frames would make the mean too long, so
/// periods are counted by the median interval.
double period_of(const std::vector<double>& intervals, double span) {
  const double mean = span / static_cast<double>(intervals.size()), median = median_of(intervals);
  if (median < mean / 2) return mean;
  double periods = 0;
  for (const double interval : intervals) periods += periods_in(interval, median);
  return span / periods;
}

/// Whether the sender's stamps grow at about the rate of arrival. They may also be frame numbers or have
/// other units.
bool counts_seconds(const Regularity& sender, const Regularity& arrival) {
  constexpr double kMostRatio = 1.5;
  return sender.period_s > 0 && sender.period_s < kMostRatio * arrival.period_s &&
         arrival.period_s < kMostRatio * sender.period_s;
}

std::int64_t delay_of(const Stamp& stamp) { return stamp.arrival_us - stamp.sender_us; }

std::int64_t least_delay_us(std::span<const Stamp> stamps) {
  std::int64_t least_us = delay_of(stamps.front());
  for (const Stamp& stamp : stamps) least_us = std::min(least_us, delay_of(stamp));
  return least_us;
}

}  // namespace

Regularity regularity_of(std::span<const std::int64_t> times_us) {
  constexpr double kMicro = 1e-6;
  const std::vector<double> intervals = intervals_of(times_us);
  const double span = times_us.empty() ? 0 : static_cast<double>(times_us.back() - times_us.front());
  if (!(span > 0)) return {};
  const double period = period_of(intervals, span);
  double square = 0;
  for (const double interval : intervals) {
    const double off = interval - periods_in(interval, period) * period;
    square += off * off;
  }
  return {kMicro * period, kMicro * std::sqrt(square / static_cast<double>(intervals.size()))};
}

TrackerClock::TrackerClock(std::span<const Stamp> first)
    : delay_us_(least_delay_us(first)), least_us_(delay_us_), last_(first.back()) {
  std::vector<std::int64_t> sent, arrived;
  for (const Stamp& stamp : first) {
    sent.push_back(stamp.sender_us);
    arrived.push_back(stamp.arrival_us);
  }
  sender_ = regularity_of(sent);
  arrival_ = regularity_of(arrived);
  const double most_s = std::max(kUsualJitter_s, 2 * arrival_.jitter_s);
  senders_ = counts_seconds(sender_, arrival_) && sender_.jitter_s <= most_s;
}

bool TrackerClock::follows(const Stamp& stamp) {
  const std::int64_t delay_us = delay_of(stamp);
  const bool jumps =
      senders_ && last_ && (stamp.sender_us < last_->sender_us - kJump_us || delay_us < least_us_ - kJump_us);
  if (jumps) restart();
  const std::int64_t passed_us = last_ ? std::max<std::int64_t>(0, stamp.arrival_us - last_->arrival_us) : 0;
  least_us_ = last_ ? std::min(delay_us, least_us_ + passed_us / kMostDrift) : delay_us;
  last_ = stamp;
  return !jumps;
}

void TrackerClock::restart() {
  if (!mapped_least_us_) mapped_least_us_ = least_us_;
  last_.reset();
}

void TrackerClock::continue_with(std::span<const Stamp> next) {
  const std::int64_t change_us = least_delay_us(next) - mapped_least_us_.value_or(least_us_);
  if (change_us < -kJump_us || change_us > kJump_us) delay_us_ += change_us;
  mapped_least_us_.reset();
}

}  // namespace astro::truth
