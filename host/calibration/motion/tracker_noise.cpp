#include "host/calibration/motion/tracker_noise.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/order_statistics.hpp"

namespace astro::calibration {
namespace {

double sigma_of(const std::vector<double>& second_differences) {
  return second_differences.empty() ? 0 : deviation_of(second_differences) / std::sqrt(6.0);
}

}  // namespace

void SecondDifferences::add(std::span<const BodySample> truth) {
  for (std::size_t i = 2; i < truth.size(); ++i) {
    const BodySample &a = truth[i - 2], &b = truth[i - 1], &c = truth[i];
    const double dx_m = a.x_m - 2 * b.x_m + c.x_m, dy_m = a.y_m - 2 * b.y_m + c.y_m;
    if (!std::isfinite(dx_m) || !std::isfinite(dy_m)) continue;
    position_m_.push_back(dx_m);
    position_m_.push_back(dy_m);
    if (std::isfinite(a.theta_rad + b.theta_rad + c.theta_rad))
      heading_rad_.push_back(wrapped_rad(c.theta_rad - b.theta_rad) - wrapped_rad(b.theta_rad - a.theta_rad));
  }
}

double SecondDifferences::sigma_xy_m() const { return sigma_of(position_m_); }
double SecondDifferences::sigma_theta_rad() const { return sigma_of(heading_rad_); }

bool mostly_headings(std::span<const BodySample> truth) {
  const auto with = std::count_if(truth.begin(), truth.end(),
                                  [](const BodySample& sample) { return std::isfinite(sample.theta_rad); });
  return 2 * static_cast<std::size_t>(with) > truth.size();
}

}  // namespace astro::calibration
