#include "host/experiment/analysis/until.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace astro::experiment {

calibration::Precision precision_of(const Calibration& calibration) {
  const double truth = std::isfinite(calibration.truth_scale_sigma) ? calibration.truth_scale_sigma : 0;
  const auto by_drives = [&](double error) {
    return std::sqrt(std::max(error * error - truth * truth, 0.0));
  };
  return {calibration.se.E_d / calibration.E_d(), by_drives(calibration.se.scale / calibration.scale()),
          by_drives(calibration.se.b_m / calibration.factors.b_m)};
}

bool reaches(const calibration::Precision& precision, double target) {
  return precision.E_d <= target && precision.scale <= target && precision.b <= target;
}

std::string described(const calibration::Precision& precision) {
  return fmt::format("E_d ± {:#.3g} %, S ± {:#.3g} %, b ± {:#.3g} %", 100 * precision.E_d,
                     100 * precision.scale, 100 * precision.b);
}

}  // namespace astro::experiment
