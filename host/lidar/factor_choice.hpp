#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "host/lidar/stretch.hpp"
#include "host/lidar/stretch_fit.hpp"

/// Which of the factors the drives show well enough to be better on other drives than the loaded ones.
///
/// The stretches are cut into five folds that each lie together. Each set of factors is estimated from four of them; on the fifth,
/// pieces of a few metres are dead-reckoned and compared with the scans, beside the loaded factors. Both have the scanner's place
/// estimated alike, which belongs to the scans and not to odometry. Of the sets whose gain is within a standard error of the best
/// one's, the smallest is taken: a factor that helps little on pieces it has not seen does harm on others. What is not in the set does
/// not stay as loaded either: it has a narrower prior, so that the drives move it as far as they show it.
namespace astro::lidar {

/// A set of factors: scale S, turns G (b / S and e), bend E (E_d).
struct FactorSet {
  std::string_view name;
  bool scale, turn, bend;

  bool has_all() const { return scale && turn && bend; }
  /// The factors in the set have their wide prior, and so have the scanner's place and, if stamps may be late, its clock. The others
  /// are near the loaded ones, as near as those of a robot that follows other drives as well without a change.
  Prior prior(const Unknowns& start, bool late) const;
};

struct FactorChoice {
  FactorSet set = {"", false, false, false};
  /// Of the logarithm of a held-out piece's error, loaded over found: mean and standard error. 0.7 is half the error.
  double gain = 0, gain_se = 0;
  std::size_t pieces = 0;              // that do not overlap, about
  double piece_m = 0;                  // length of a piece
  double loaded_rms_m = 0, rms_m = 0;  // over the held-out pieces

  /// Better by two standard errors, and by a tenth at least, in the typical error and in the root mean square: less than that may
  /// be a bias of the matches, which the held-out pieces share.
  bool better() const;
  bool worse() const;  // by two standard errors, and by the mean square
};

/// Whether there are enough stretches and pieces to judge by.
bool can_be_judged(const FactorChoice& choice);

/// `at`, `linear`: linearised at the estimate of all unknowns. `start`: loaded factors and the start values of the scanner's place.
FactorChoice choose_factors(std::span<const Stretch> stretches, std::span<const LinearStretch> linear,
                            const Unknowns& at, const Unknowns& start, bool late,
                            const calibration::WheelFactors& loaded);

}  // namespace astro::lidar
