#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <utility>

namespace astro::simulation {

/// A number that is uniform in [0, 1).
inline double uniform(std::mt19937_64& random) {
  const double value = static_cast<double>(random()) * 0x1p-64;
  return value < 1 ? value : 1 - std::numeric_limits<double>::epsilon() / 2;
}

/// Standard normal deviates by the polar method, which makes two at a time.
///
/// A seed is to give the same robot in every build, also in the browser's, and each standard library has its own way from a
/// generator to a distribution. This is that of libstdc++, number for number.
///
/// Source  Marsaglia, Bray, "A convenient method for generating normal variables", SIAM Review 6, 1964.
class NormalDeviates {
 public:
  double operator()(std::mt19937_64& random) {
    if (second_) return *std::exchange(second_, std::nullopt);
    double x = 0, y = 0, square = 0;
    do {
      x = 2 * uniform(random) - 1;
      y = 2 * uniform(random) - 1;
      square = x * x + y * y;
    } while (square > 1 || square == 0);
    const double factor = std::sqrt(-2 * std::log(square) / square);
    second_ = x * factor;
    return y * factor;
  }

 private:
  std::optional<double> second_;
};

}  // namespace astro::simulation
