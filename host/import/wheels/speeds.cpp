#include "host/import/wheels/speeds.hpp"

#include <fmt/format.h>

#include <cmath>

namespace astro::importing {
namespace {

double seconds(const WheelSample& from, const WheelSample& to) {
  return 1e-9 * static_cast<double>(to.time_ns - from.time_ns);
}

/// Of both wheels together.
double half_sum(const WheelSample& speeds) { return (speeds.left + speeds.right) / 2; }

}  // namespace

void integrate(std::span<const WheelSample> speeds, WheelTrack& track) {
  WheelSample sum;
  double squares = 0, path = 0;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const WheelSample &at = speeds[i], &before = speeds[i == 0 ? 0 : i - 1];
    const double half_s = seconds(before, at) / 2;
    sum = {at.time_ns, sum.left + half_s * (at.left + before.left),
           sum.right + half_s * (at.right + before.right)};
    track.samples.push_back(sum);
    path += 2 * half_s * std::abs(half_sum(at));
    if (i < 2 || i % 2 == 1) continue;
    const WheelSample& first = speeds[i - 2];
    const double fine = seconds(first, before) / 2 * (half_sum(first) + half_sum(before)) +
                        half_s * (half_sum(before) + half_sum(at));
    const double coarse = seconds(first, at) / 2 * (half_sum(first) + half_sum(at));
    squares += (fine - coarse) * (fine - coarse) / 9;
  }
  const std::string percent = fmt::format("{:.2g}", path > 0 ? 100 * std::sqrt(squares) / path : 0);
  track.remarks.push_back(
      {"the wheels have speeds and no travel; these were integrated, and their sampling leaves the "
       "travel uncertain by " +
           percent + " %",
       WheelRemark::speeds_integrated,
       {percent}});
}

}  // namespace astro::importing
