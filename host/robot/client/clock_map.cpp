#include "host/robot/client/clock_map.hpp"

#include <algorithm>
#include <cmath>

namespace astro::robot {

namespace {

double rtt_us(const RoundTrip& trip) {
  // A round trip takes at least one step of the clock that times it.
  return static_cast<double>(std::max<std::int64_t>(trip.received_us - trip.sent_us, 1));
}

double weight(const RoundTrip& trip) { return 1 / (rtt_us(trip) * rtt_us(trip)); }

double device_from(const RoundTrip& origin, std::uint64_t device_us) {
  return static_cast<double>(static_cast<std::int64_t>(device_us - origin.device_us));
}

double middle_from(const RoundTrip& origin, const RoundTrip& trip) {
  return static_cast<double>(trip.sent_us - origin.sent_us) +
         0.5 * static_cast<double>(trip.received_us - trip.sent_us);
}

}  // namespace

void ClockMap::add(const RoundTrip& trip) {
  if (!best_ || rtt_us(trip) < rtt_us(*best_)) best_ = trip;
  if (++in_group_ < kGroup) return;
  if (kept_.size() == kKept) kept_.erase(kept_.begin());
  kept_.push_back(*best_);
  best_.reset();
  in_group_ = 0;
}

std::vector<RoundTrip> ClockMap::used() const {
  std::vector<RoundTrip> trips = kept_;
  if (best_) trips.push_back(*best_);
  return trips;
}

ClockMap::Fit ClockMap::fit(const std::vector<RoundTrip>& trips) {
  constexpr double kSpanForSlope = 10;  // round trips; below, the error of a slope would exceed 10 %
  Fit result;
  const RoundTrip& origin = trips.back();
  double fastest = rtt_us(origin);
  for (const RoundTrip& trip : trips) {
    const double w = weight(trip);
    result.weight += w;
    result.device += w * device_from(origin, trip.device_us);
    result.host += w * middle_from(origin, trip);
    fastest = std::min(fastest, rtt_us(trip));
  }
  result.device /= result.weight;
  result.host /= result.weight;
  double product = 0;
  for (const RoundTrip& trip : trips) {
    const double d = device_from(origin, trip.device_us) - result.device;
    result.spread += weight(trip) * d * d;
    product += weight(trip) * d * (middle_from(origin, trip) - result.host);
  }
  const double span = static_cast<double>(origin.received_us - trips.front().sent_us);
  result.measured = span > kSpanForSlope * fastest && result.spread > 0 && product > 0;
  if (result.measured) result.slope = product / result.spread;
  return result;
}

std::optional<HostTime> ClockMap::to_host(std::uint64_t device_us) const {
  const std::vector<RoundTrip> trips = used();
  if (trips.empty()) return std::nullopt;
  const Fit line = fit(trips);
  const RoundTrip& origin = trips.back();
  const double t = device_from(origin, device_us) - line.device;
  double bound = 1 + (line.measured ? 0 : kGreatestDrift * std::abs(t));
  for (const RoundTrip& trip : trips) {
    double share = weight(trip) / line.weight;
    if (line.measured) {
      share += weight(trip) * (device_from(origin, trip.device_us) - line.device) * t / line.spread;
    }
    bound += std::abs(share) * (0.5 * rtt_us(trip) + 1);  // 1: both clocks count whole microseconds
  }
  return HostTime{origin.sent_us + std::llround(line.host + line.slope * t), bound};
}

std::optional<std::int64_t> ClockMap::to_device(std::int64_t host_us) const {
  const std::vector<RoundTrip> trips = used();
  if (trips.empty()) return std::nullopt;
  const Fit line = fit(trips);
  const RoundTrip& origin = trips.back();
  const double t = (static_cast<double>(host_us - origin.sent_us) - line.host) / line.slope;
  return static_cast<std::int64_t>(origin.device_us) + std::llround(line.device + t);
}

std::optional<double> ClockMap::drift() const {
  const std::vector<RoundTrip> trips = used();
  if (trips.empty()) return std::nullopt;
  const Fit line = fit(trips);
  if (!line.measured) return std::nullopt;
  return 1 / line.slope - 1;
}

}  // namespace astro::robot
