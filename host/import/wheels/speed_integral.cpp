#include "host/import/wheels/speed_integral.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace astro::importing {
namespace {

WheelSample trapezoid(const WheelSample& sum, const WheelSample& from, const WheelSample& to) {
  const double half_s = 0.5e-9 * static_cast<double>(to.time_ns - from.time_ns);
  return {to.time_ns, sum.left + half_s * (to.left + from.left),
          sum.right + half_s * (to.right + from.right)};
}

}  // namespace

std::vector<WheelSample> integral_of(const std::vector<WheelSample>& speeds, const std::string& what,
                                     std::vector<Remark>& remarks) {
  std::vector<WheelSample> travel;
  travel.reserve(speeds.size());
  WheelSample coarse;
  double way = 0, error = 0;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    travel.push_back(i == 0 ? WheelSample{speeds[0].time_ns, 0, 0}
                            : trapezoid(travel.back(), speeds[i - 1], speeds[i]));
    if (i == 0) continue;
    way += std::max(std::abs(travel[i].left - travel[i - 1].left),
                    std::abs(travel[i].right - travel[i - 1].right));
    if (i % 2 != 0) continue;
    coarse = trapezoid(coarse, speeds[i - 2], speeds[i]);
    error = std::max(
        {error, std::abs(coarse.left - travel[i].left) / 3, std::abs(coarse.right - travel[i].right) / 3});
  }
  const std::string percent = fmt::format("{:.2g}", way > 0 ? 100 * error / way : 0);
  remarks.push_back(
      {what + " were integrated; the sampling may leave an error of " + percent + " % of the travel",
       WheelRemark::speeds_integrated,
       {percent}});
  return travel;
}

}  // namespace astro::importing
