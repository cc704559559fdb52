#include "host/calibration/wall/wall_scale.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "host/calibration/motion/arc.hpp"

namespace astro::calibration {
namespace {

/// The same ratios with a mean wheel factor of 1.
WheelFactors without_scale(WheelFactors factors) {
  const double scale = (factors.c_r + factors.c_l) / 2;
  factors.c_r /= scale;
  factors.c_l /= scale;
  factors.b_m /= scale;
  return factors;
}

struct Backing {
  double driven_m = 0, gap_m = 0, variance_m2 = 0;
};

std::vector<Backing> backings_of(const WallDrive& drive, const WheelFactors& factors,
                                 const WallNoise& noise) {
  std::vector<Backing> backings;
  for (const WallSeries& series : drive) {
    for (const GapReading& reading : series.readings) {
      const WheelTravel since = reading.travel - series.squarings.at(reading.squaring);
      backings.push_back({backed_off_m(since, factors), reading.gap_m,
                          noise.K_m * since.path_m() / 4 + noise.reading_m * noise.reading_m});
    }
  }
  return backings;
}

}  // namespace

double backed_off_m(const WheelTravel& since_squaring, const WheelFactors& factors) {
  const double right_m = factors.c_r * since_squaring.right_m, left_m = factors.c_l * since_squaring.left_m;
  return -(right_m + left_m) / 2 * sinc((right_m - left_m) / factors.b_m);
}

std::optional<WallScale> scale_of_gaps(const WallDrive& drive, const WheelFactors& factors,
                                       const WallNoise& noise) {
  const std::vector<Backing> backings = backings_of(drive, without_scale(factors), noise);
  if (backings.empty()) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(backings.size());
  Eigen::VectorXd driven_m(count), gap_m(count);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(count, count, noise.contact_m * noise.contact_m);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Backing& backing = backings[static_cast<std::size_t>(i)];
    driven_m[i] = backing.driven_m;
    gap_m[i] = backing.gap_m;
    covariance(i, i) += backing.variance_m2;
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  const Eigen::VectorXd weighted = llt.solve(driven_m);
  const double information = weighted.dot(driven_m);
  return WallScale{weighted.dot(gap_m) / information, 1 / std::sqrt(information), static_cast<int>(count)};
}

}  // namespace astro::calibration
