#include "host/wall/wall_scale.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "host/base/pose2.hpp"

namespace astro::wall {
namespace {

/// The same ratios with a mean wheel factor of 1.
calibration::WheelFactors without_scale(calibration::WheelFactors factors) {
  const double scale = (factors.c_r + factors.c_l) / 2;
  factors.c_r /= scale;
  factors.c_l /= scale;
  factors.b_m /= scale;
  return factors;
}

struct Backing {
  double driven_m = 0, gap_m = 0, variance_m2 = 0;
  std::size_t series = 0, reading = 0;
};

std::vector<Backing> backings_of(const WallDrive& drive, const calibration::WheelFactors& factors,
                                 const WallNoise& noise) {
  std::vector<Backing> backings;
  for (std::size_t s = 0; s < drive.size(); ++s) {
    for (std::size_t i = 0; i < drive[s].readings.size(); ++i) {
      const GapReading& reading = drive[s].readings[i];
      const WheelTravel since = reading.travel - drive[s].squarings.at(reading.squaring);
      backings.push_back({backed_off_m(since, factors), reading.gap_m,
                          noise.K_m * since.path_m() / 4 + noise.reading_m * noise.reading_m, s, i});
    }
  }
  return backings;
}

struct Line {
  double scale = 1, se = 0, chi_square = 0;
};

/// gap = scale * driven by generalised least squares.
Line fitted(const std::vector<Backing>& backings, double contact_m) {
  const auto count = static_cast<Eigen::Index>(backings.size());
  Eigen::VectorXd driven_m(count), gap_m(count);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(count, count, contact_m * contact_m);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Backing& backing = backings[static_cast<std::size_t>(i)];
    driven_m[i] = backing.driven_m;
    gap_m[i] = backing.gap_m;
    covariance(i, i) += backing.variance_m2;
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  const Eigen::VectorXd weighted = llt.solve(driven_m);
  const double information = weighted.dot(driven_m), scale = weighted.dot(gap_m) / information;
  const Eigen::VectorXd residual = gap_m - scale * driven_m;
  return {scale, 1 / std::sqrt(information), residual.dot(llt.solve(residual))};
}

double scatter_of(const std::vector<Backing>& backings, const Line& line) {
  if (backings.size() < 2) return 1;
  return std::max(1.0, std::sqrt(line.chi_square / static_cast<double>(backings.size() - 1)));
}

/// The readings without the one that fits the others worst.
std::vector<Backing> without_worst(const std::vector<Backing>& backings, double contact_m) {
  std::vector<Backing> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < backings.size(); ++i) {
    std::vector<Backing> others = backings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const double chi_square = fitted(others, contact_m).chi_square;
    if (chi_square >= least) continue;
    least = chi_square;
    best = std::move(others);
  }
  return best;
}

/// The readings without those that contradict them, if most agree; otherwise all.
std::vector<Backing> agreeing(const std::vector<Backing>& all, double contact_m) {
  constexpr double kLimit = WallScale::kContradictory * WallScale::kContradictory;
  std::vector<Backing> kept = all;
  while (true) {
    const Line line = fitted(kept, contact_m);
    std::vector<Backing> others = without_worst(kept, contact_m);
    const bool most = 2 * others.size() > all.size();
    if (most && line.chi_square - fitted(others, contact_m).chi_square >= kLimit)
      kept = std::move(others);
    else
      return scatter_of(kept, line) > WallScale::kContradictory ? all : kept;
  }
}

}  // namespace

double backed_off_m(const WheelTravel& since_squaring, const calibration::WheelFactors& factors) {
  const double right_m = factors.c_r * since_squaring.right_m, left_m = factors.c_l * since_squaring.left_m;
  return -(right_m + left_m) / 2 * sinc((right_m - left_m) / factors.b_m);
}

std::optional<WallScale> scale_of_gaps(const WallDrive& drive, const calibration::WheelFactors& factors,
                                       const WallNoise& noise) {
  const std::vector<Backing> all = backings_of(drive, without_scale(factors), noise);
  if (all.empty()) return std::nullopt;
  const std::vector<Backing> kept = agreeing(all, noise.contact_m);
  const Line line = fitted(kept, noise.contact_m);
  const double scatter = scatter_of(kept, line);
  return WallScale{line.scale, scatter * line.se, static_cast<int>(kept.size()),
                   static_cast<int>(all.size() - kept.size()), scatter};
}

WallDrive without_contradicted(const WallDrive& drive, const calibration::WheelFactors& factors,
                               const WallNoise& noise) {
  WallDrive kept = drive;
  for (WallSeries& series : kept) series.readings.clear();
  const std::vector<Backing> all = backings_of(drive, without_scale(factors), noise);
  if (all.empty()) return kept;
  for (const Backing& one : agreeing(all, noise.contact_m))
    kept[one.series].readings.push_back(drive[one.series].readings[one.reading]);
  return kept;
}

}  // namespace astro::wall
