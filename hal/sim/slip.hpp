#pragma once

#include <cmath>
#include <cstdint>

#include "hal/sim/noise.hpp"

/// White wheel slip: a wheel's true travel differs from its rolled distance by noise of variance K
/// |distance|.
///
/// The noise depends on the distance, not on time. The total rolled distance in either direction is divided
/// into cells of 1 mm; cell n has one Gaussian g(seed, wheel, n), and within it travel = rolled (1 + g sqrt(K
/// / cell)). So the result does not depend on how the distance is divided into calls, and rolling back over
/// the same ground gives new noise. Rejected: noise per call with variance K |d|, which would make every run
/// depend on its schedule.
///
/// Cost    one Gaussian per millimetre and wheel.
namespace astro::sim {

class Slip {
 public:
  static constexpr double kCell_m = 1e-3;

  /// `slip_m` is K; `wheel` selects the stream of random numbers.
  Slip(std::uint64_t seed, std::uint64_t wheel, double slip_m)
      : key_(stream_key(seed, wheel)), sigma_(std::sqrt(slip_m / kCell_m)) {
    enter(0);
  }

  /// True travel for a signed rolled distance.
  double travel(double rolled_m) {
    double rest_m = std::abs(rolled_m), travelled_m = 0.0;
    while (rest_m > left_m_) {
      travelled_m += left_m_ * factor_;
      rest_m -= left_m_;
      enter(cell_ + 1);
    }
    travelled_m += rest_m * factor_;
    left_m_ -= rest_m;
    return std::copysign(travelled_m, rolled_m);
  }

 private:
  void enter(std::uint64_t cell) {
    cell_ = cell;
    left_m_ = kCell_m;
    factor_ = sigma_ > 0.0 ? 1.0 + sigma_ * gauss(key_, cell) : 1.0;
  }

  std::uint64_t key_;
  double sigma_;
  std::uint64_t cell_ = 0;
  double left_m_ = kCell_m;  // of the current cell
  double factor_ = 1.0;
};

}  // namespace astro::sim
