#include "host/lidar/piece_errors.hpp"

#include <cmath>
#include <limits>

namespace astro::lidar {

std::vector<PieceError> piece_errors(std::span<const Stretch> stretches, double length_m,
                                     const Unknowns& unknowns, const calibration::WheelFactors& loaded) {
  std::vector<Pose2> by_wheels;
  for (const Stretch& stretch : stretches) by_wheels.push_back(predicted(stretch, unknowns, loaded));
  std::vector<PieceError> errors;
  for (std::size_t first = 0; first < stretches.size(); ++first) {
    Pose2 wheels, scans;
    double driven_m = 0;
    for (std::size_t i = first; i < stretches.size() && driven_m < length_m; ++i) {
      const std::optional<ScannerMotion>& scanner = stretches[i].scanner;
      if (!scanner || scanner->degenerate || (i > first && stretches[i].new_drive)) break;
      wheels = wheels * by_wheels[i];
      scans = scans * scanner->motion;
      driven_m += std::hypot(scanner->motion.x_m, scanner->motion.y_m);
    }
    if (driven_m < length_m) continue;
    const Pose2 apart = difference(wheels, scans);
    errors.push_back({first, std::hypot(apart.x_m, apart.y_m), apart.theta_rad});
  }
  return errors;
}

double rms_m(std::span<const PieceError> errors) {
  double sum = 0;
  for (const PieceError& error : errors) sum += error.distance_m * error.distance_m;
  return errors.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : std::sqrt(sum / static_cast<double>(errors.size()));
}

}  // namespace astro::lidar
