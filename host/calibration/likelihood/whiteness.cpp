#include "host/calibration/likelihood/whiteness.hpp"

#include <algorithm>

#include "host/calibration/likelihood/agreement.hpp"

namespace astro::calibration {
namespace {

// With some forty sums, one drive in a hundred exceeds this by chance. It is then thinned, which
// costs little: slip, not the tracker, sets the errors.
constexpr double kUnlikely = 1e-4;
constexpr double kMatters = 1.2;  // ratio of variances: a tenth of a standard error
constexpr int kPerUnknown =
    2;  // with fewer sums or squares, the fitted unknowns take most of what these could show

struct BlockSums {
  Eigen::Vector3d mean_square =
      Eigen::Vector3d::Zero();  // of the sums over `length` innovations, divided by `length`
  int blocks = 0;
};

BlockSums sums_over(std::span<const std::vector<Eigen::Vector3d>> runs, std::size_t length) {
  BlockSums sums;
  for (const std::vector<Eigen::Vector3d>& run : runs)
    for (std::size_t begin = 0; begin + length <= run.size(); begin += length) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t i = begin; i < begin + length; ++i) sum += run[i];
      sums.mean_square += sum.cwiseAbs2() / static_cast<double>(length);
      ++sums.blocks;
    }
  if (sums.blocks > 0) sums.mean_square /= sums.blocks;
  return sums;
}

/// A single large innovation would outweigh thousands of others, so none counts for more than the 99 %
/// quantile of normal ones.
constexpr double kFarSquared = 11.345;

Eigen::Vector3d mean_square(std::span<const Eigen::Vector3d> innovations) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& innovation : innovations)
    sum += innovation.cwiseAbs2() * std::min(1.0, kFarSquared / innovation.squaredNorm());
  return sum / std::max(1.0, static_cast<double>(innovations.size()));
}

/// For a mean of `count` squares whose expectation is 1 or, because of the fit, as little as `left`.
bool is_far(double mean_square, double left, int count) {
  if (mean_square > kMatters) return chi_square_tail(mean_square * count, count) < kUnlikely;
  const double at_least = mean_square / left;
  return at_least < 1 / kMatters && 1 - chi_square_tail(at_least * count, count) < kUnlikely;
}

}  // namespace

bool are_independent(std::span<const std::vector<Eigen::Vector3d>> runs, int fitted) {
  const Eigen::Vector3d single = sums_over(runs, 1).mean_square;
  const auto components = static_cast<int>((single.array() > 0).count());
  for (std::size_t length = 2;; length *= 2) {
    const BlockSums sums = sums_over(runs, length);
    if (components == 0 || sums.blocks < kPerUnknown * std::max(1, fitted)) return true;
    const int count = components * sums.blocks;
    const double left = 1 - static_cast<double>(fitted) / count;
    if (is_far(sums.mean_square.sum() / single.sum(), left, count)) return false;
    // One component may have determined all that was fitted.
    if (sums.blocks < 2 * kPerUnknown * fitted) continue;
    for (int i = 0; i < 3; ++i)
      if (single[i] > 0 && is_far(sums.mean_square[i] / single[i], left, sums.blocks)) return false;
  }
}

std::size_t fewest_innovations(int fitted) {
  return static_cast<std::size_t>(kPerUnknown) * static_cast<std::size_t>(std::max(1, fitted));
}

bool hold_over_path(std::span<const std::vector<Eigen::Vector3d>> spacings, int fitted) {
  if (spacings.empty()) return true;
  const Eigen::Vector3d near = mean_square(spacings.front());
  const auto components = static_cast<int>((near.array() > 0).count());
  if (components == 0) return true;
  for (const std::vector<Eigen::Vector3d>& wider : spacings.subspan(1)) {
    if (wider.size() < fewest_innovations(fitted)) return true;
    const Eigen::Vector3d far = mean_square(wider);
    const int count = components * static_cast<int>(wider.size());
    const double left = 1 - static_cast<double>(fitted) / count;
    if (is_far(far.sum() / near.sum(), left, count)) return false;
    // One component may have determined all that was fitted.
    if (wider.size() < 2 * fewest_innovations(fitted)) continue;
    for (int i = 0; i < 3; ++i)
      if (near[i] > 0 && is_far(far[i] / near[i], left, static_cast<int>(wider.size()))) return false;
  }
  return true;
}

}  // namespace astro::calibration
