#include "host/calibration/gyro/gyro_slips.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "host/base/order_statistics.hpp"

namespace astro::calibration {
namespace {

constexpr double kWindows_s[] = {0.15, 0.3};
constexpr double kDeviations = 5.5, kLeast_rad = 0.6 * std::numbers::pi / 180;
constexpr double kOfTurn = 0.001;  // that scale and wheelbase may be off
constexpr double kCalm_s = 0.3;    // that ends a slip

/// What the gyro turned beyond the wheels, at the wheels' samples.
struct Beyond {
  const WheelTurn* wheels = nullptr;
  double rad = 0;
  int piece = 0;
};

std::vector<Beyond> beyond(std::span<const WheelTurn> wheels, const GyroPath& gyro,
                           const GyroFollowing& following) {
  std::vector<Beyond> all;
  for (const WheelTurn& now : wheels) {
    const GyroPath::Place place = gyro.at(now.time_s + following.lag_s);
    if (!place.known) continue;
    const double heading_rad = place.turn_rad / following.product + following.by_way_radpm * now.way_m +
                               following.drift_radps * (now.time_s - wheels.front().time_s);
    all.push_back({&now, heading_rad - now.pose.theta_rad, place.piece});
  }
  return all;
}

double deviation(const Beyond& from, const Beyond& to, const GyroFollowing& following) {
  const WheelTurn &was = *from.wheels, &is = *to.wheels;
  const TurnNoise& noise = following.noise;
  const double span_s = is.time_s - was.time_s;
  const double clock_rad = following.doubt_s * (is.rate_radps - was.rate_radps),
               scale_rad = kOfTurn * (is.pose.theta_rad - was.pose.theta_rad);
  return std::sqrt(noise.gyro_rad2ps * span_s + noise.slip_rad2pm * (is.path_m - was.path_m) +
                   2 * noise.reading_rad2 + clock_rad * clock_rad + scale_rad * scale_rad);
}

/// The stretches between samples `from` and `to` where a window shows a slip.
struct Stretch {
  std::size_t from = 0, to = 0;
};

std::vector<Stretch> slipping(const std::vector<Beyond>& all, double window_s,
                              const GyroFollowing& following) {
  struct Window {
    Stretch stretch;
    double beyond_rad = 0, deviations = 0;
  };
  std::vector<Window> windows;
  std::vector<double> moving;
  std::size_t from = 0;
  for (std::size_t to = 1; to < all.size(); ++to) {
    while (from + 1 < to && all[from + 1].wheels->time_s <= all[to].wheels->time_s - window_s) ++from;
    if (all[from].piece != all[to].piece) continue;
    const double off_rad = all[to].rad - all[from].rad, sigma_rad = deviation(all[from], all[to], following);
    windows.push_back({{from, to}, off_rad, off_rad / sigma_rad});
    if (all[to].wheels->path_m > all[from].wheels->path_m) moving.push_back(off_rad / sigma_rad);
  }
  if (moving.empty()) return {};
  const double limit = kDeviations * std::max(1.0, deviation_of(moving));
  std::vector<Stretch> found;
  for (const Window& window : windows)
    if (std::abs(window.deviations) > limit && std::abs(window.beyond_rad) > kLeast_rad)
      found.push_back(window.stretch);
  return found;
}

}  // namespace

std::vector<UnseenTurn> unseen_turns(std::span<const WheelTurn> wheels, const GyroPath& gyro,
                                     const GyroFollowing& following) {
  const std::vector<Beyond> all = beyond(wheels, gyro, following);
  if (all.size() < 2) return {};
  std::vector<Stretch> stretches;
  for (const double window_s : kWindows_s) {
    const std::vector<Stretch> found = slipping(all, window_s, following);
    stretches.insert(stretches.end(), found.begin(), found.end());
  }
  std::ranges::sort(stretches, {}, &Stretch::from);
  std::vector<Stretch> merged;
  for (const Stretch& stretch : stretches) {
    if (!merged.empty() && all[stretch.from].wheels->time_s <= all[merged.back().to].wheels->time_s + kCalm_s)
      merged.back().to = std::max(merged.back().to, stretch.to);
    else
      merged.push_back(stretch);
  }
  std::vector<UnseenTurn> found;
  for (const Stretch& stretch : merged) {
    const Beyond &from = all[stretch.from], &to = all[stretch.to];
    found.push_back({0, {from.wheels->time_s, to.wheels->time_s, to.rad - from.rad}, from.wheels->pose});
  }
  return found;
}

}  // namespace astro::calibration
