#pragma once

#include <string>

#include "host/calibration/judgement/before_after.hpp"
#include "host/wall/wall_estimate.hpp"

/// Whether the factors from a wall are better than the loaded ones, by cross-validation: each stretch between two squarings,
/// and each gap, is predicted with the loaded factors and with factors found from all others.
namespace astro::wall {

struct WallJudgement {
  int stretches = 0, better_on = 0;
  /// Root mean square error of the headings at the ends of the stretches.
  double loaded_rad = 0, found_rad = 0;
  /// From stretches and gaps; never better if readings contradict each other.
  calibration::Verdict verdict = calibration::Verdict::unknown;
  bool readings_contradict = false;

  /// With fewer stretches the verdict is unknown, or undecided if readings contradict each other.
  static constexpr int kFewest = 3;

  /// "Better: on 12 of 14 ways that they had not seen ... the heading at their ends is off by 24 mrad instead of 98 mrad."
  std::string sentence() const;
};

WallJudgement judge_wall(const WallDrive& drive, const WallEstimate& found,
                         const calibration::WheelFactors& loaded);

}  // namespace astro::wall
