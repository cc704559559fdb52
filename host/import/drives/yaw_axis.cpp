#include "host/import/drives/yaw_axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "host/base/microseconds.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

using Axis = std::array<double, 3>;
using recording::OdometrySample;

double about(const Axis& axis, const ImuRate& sample) {
  return axis[0] * sample.rate_radps[0] + axis[1] * sample.rate_radps[1] + axis[2] * sample.rate_radps[2];
}

/// The correlation of the rate about each of the sensor's axes with the wheels' yaw rate `lag_us` before; 0 if one of them is constant.
std::array<double, 3> correlations(const std::vector<ImuRate>& samples,
                                   const std::vector<OdometrySample>& odometry, std::int64_t lag_us) {
  double n = 0, sum_w = 0, sum_ww = 0;
  Axis sum{}, squares{}, products{};
  auto at = odometry.begin();
  for (const ImuRate& sample : samples) {
    const std::int64_t time_us = whole_microseconds(sample.time_ns) - lag_us;
    while (at != odometry.end() && at->time_us < time_us) ++at;
    if (at == odometry.end()) break;
    if (at == odometry.begin()) continue;
    const double wheels = at->omega_radps;
    n += 1;
    sum_w += wheels;
    sum_ww += wheels * wheels;
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] += sample.rate_radps[i];
      squares[i] += sample.rate_radps[i] * sample.rate_radps[i];
      products[i] += sample.rate_radps[i] * wheels;
    }
  }
  std::array<double, 3> found{};
  const double spread_w = n * sum_ww - sum_w * sum_w;
  for (std::size_t i = 0; i < 3; ++i) {
    const double spread = n * squares[i] - sum[i] * sum[i];
    if (spread > 0 && spread_w > 0)
      found[i] = (n * products[i] - sum[i] * sum_w) / std::sqrt(spread * spread_w);
  }
  return found;
}

/// With its sign; nothing if no axis follows the wheels.
std::optional<Axis> axis_by_wheels(const std::vector<ImuRate>& samples,
                                   const std::vector<OdometrySample>& odometry) {
  constexpr double kFollows =
      0.6;  // noise of a thousand samples gives 0.1, a lag within the steps below takes a tenth away
  constexpr std::int64_t kStep_us = 50'000, kMost_us = 400'000;
  double best = 0;
  std::size_t which = 0;
  for (std::int64_t lag_us = -kStep_us; lag_us <= kMost_us; lag_us += kStep_us) {
    const std::array<double, 3> all = correlations(samples, odometry, lag_us);
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(all[i]) > std::abs(best)) {
        best = all[i];
        which = i;
      }
  }
  if (std::abs(best) < kFollows) return std::nullopt;
  Axis axis{};
  axis[which] = best < 0 ? -1 : 1;
  return axis;
}

std::string name_of(const Axis& axis) {
  for (std::size_t i = 0; i < 3; ++i)
    if (axis[i] != 0) return std::string(axis[i] < 0 ? "-" : "") + "xyz"[i];
  return "";
}

}  // namespace

std::vector<recording::YawRate> yaw_rates_of(ImuRates rates, const std::vector<OdometrySample>& odometry,
                                             const std::optional<Axis>& stated,
                                             std::vector<Remark>& remarks) {
  remarks.insert(remarks.end(), rates.remarks.begin(), rates.remarks.end());
  if (rates.samples.empty()) return {};
  const std::optional<Axis> axis = stated ? stated : axis_by_wheels(rates.samples, odometry);
  if (!axis) {
    remarks.push_back(
        {"the gyro of " + rates.topic + " is not used: about none of its axes it turns as the wheels do",
         ChoiceRemark::yaw_axis_unclear,
         {rates.topic}});
    return {};
  }
  if (!stated) {
    const std::string name = name_of(*axis);
    remarks.push_back({"the yaw rate is that about " + name + " of " + rates.topic +
                           (name[0] == '-' ? ", as if it hung upside down" : ""),
                       ChoiceRemark::yaw_axis_recognised,
                       {name, rates.topic}});
  }
  std::vector<recording::YawRate> yaw;
  yaw.reserve(rates.samples.size());
  for (const ImuRate& sample : rates.samples)
    yaw.push_back({whole_microseconds(sample.time_ns), about(*axis, sample)});
  return yaw;
}

}  // namespace astro::importing
