#include "host/calibration/judgement/student_t.hpp"

#include <array>
#include <limits>

namespace astro::calibration {
namespace {

constexpr std::size_t kTabled = 10;

/// From a table where the expansion is worse than the table's three decimals, else by Cornish and Fisher's expansion about
/// the normal quantile z (Abramowitz & Stegun 26.7.5).
double quantile(const std::array<double, kTabled>& table, double z, int degrees_of_freedom) {
  if (degrees_of_freedom < 1) return std::numeric_limits<double>::infinity();
  const auto index = static_cast<std::size_t>(degrees_of_freedom - 1);
  if (index < kTabled) return table[index];
  const double n = degrees_of_freedom, z3 = z * z * z, z5 = z3 * z * z;
  return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n);
}

}  // namespace

double student_t_975(int degrees_of_freedom) {
  return quantile({12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228}, 1.959964,
                  degrees_of_freedom);
}

double student_t_90(int degrees_of_freedom) {
  return quantile({3.078, 1.886, 1.638, 1.533, 1.476, 1.440, 1.415, 1.397, 1.383, 1.372}, 1.281552,
                  degrees_of_freedom);
}

double chi_square_95(int degrees_of_freedom) {
  constexpr std::array<double, 5> kQuantiles{0, 3.841, 5.991, 7.815, 9.488};
  return kQuantiles.at(static_cast<std::size_t>(degrees_of_freedom));
}

}  // namespace astro::calibration
