#include "host/calibration/likelihood/noise_of_ends.hpp"

#include <algorithm>

namespace astro::calibration {
namespace {

constexpr int kRounds = 6;  // each leaves a quarter to a half of the distance (60 simulated sets)
constexpr double kPriorWeight = 4;
constexpr double kMostAtOnce = 10;

}  // namespace

NoiseModel noise_of_ends(std::span<const Trajectory> runs, const WheelFactors& loaded, MlOptions options,
                         const NoiseModel& reading) {
  NoiseModel noise = reading;
  options.robust = false;  // a weight below one would hide the slip that is looked for
  for (int round = 0; round < kRounds; ++round) {
    options.noise = noise;
    const MlEstimate fit = estimate_ml(runs, loaded, options);
    // Fitted were the factors and the place of the body in each session.
    const auto fitted = static_cast<int>(3 + 3 * fit.sessions.size());
    const double freedom = std::max(0, fit.degrees_of_freedom - fitted);
    const double usual = reading.K_m / noise.K_m;  // of the chi-square that this slip would give
    const double ratio = (fit.chi_square + kPriorWeight * usual) / (freedom + kPriorWeight);
    noise.K_m *= std::clamp(ratio, 1 / kMostAtOnce, kMostAtOnce);
  }
  return noise;
}

}  // namespace astro::calibration
