#include "host/calibration/end_poses/robust_weight.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/order_statistics.hpp"

namespace astro::calibration {
namespace {

constexpr double kPriorNumbers = 4;

/// The value that chi-square with `count` degrees of freedom stays below with a probability near 0.5: Wilson and Hilferty's
/// cube, and a straight line for the normal quantile.
double usual_square(double count, double probability) {
  const double spread = 2 / (9 * count), normal = 2.5066 * (probability - 0.5);
  return count * std::pow(1 - spread + normal * std::sqrt(spread), 3);
}

}  // namespace

double robust_weight(const Distance& distance, double scatter) {
  constexpr double kFreedom = 6, kClosestToNormal = 0.79;
  return (kFreedom + distance.count) / (kFreedom + distance.square / (kClosestToNormal * scatter));
}

double robust_scatter(const std::vector<Distance>& distances, double fitted) {
  if (distances.empty()) return 1;
  const std::size_t middle = (distances.size() - 1) / 2;  // of an even number the lower one
  const double probability = static_cast<double>(middle + 1) / static_cast<double>(distances.size() + 1);
  std::vector<double> ratios;
  double numbers = 0;
  for (const Distance& one : distances) {
    ratios.push_back(one.square / usual_square(one.count, probability));
    numbers += one.count;
  }
  return (lower_median_of(std::move(ratios)) * numbers + kPriorNumbers) /
         (std::max(0.0, numbers - fitted) + kPriorNumbers);
}

double scatter_for_errors(const std::vector<Distance>& distances, double scatter, double fitted) {
  constexpr double kWeightedSquare =
      0.8;  // its mean for normal numbers: 0.79 of two that belong together, 0.80 of three
  constexpr double kEfficiency = 0.9;  // of a variance from these squares, against that of normal numbers
  double squares = 0, numbers = 0;
  for (const Distance& one : distances) {
    squares += robust_weight(one, scatter) * one.square / kWeightedSquare;
    numbers += one.count;
  }
  const double free = std::max(1.0, numbers - fitted), own = squares / free;
  const double found = std::max(own, (squares + kPriorNumbers) / (free + kPriorNumbers));
  // The mean of 1 / chi-square with so many degrees of freedom, which is infinite for two.
  const double freedom = kEfficiency * free + kPriorNumbers * std::min(1.0, 1 / own);
  return found * freedom / std::max(0.5, freedom - 2);
}

}  // namespace astro::calibration
