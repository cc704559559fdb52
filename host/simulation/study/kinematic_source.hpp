#pragma once

#include "host/simulation/study/drive_source.hpp"

namespace astro::simulation::study {

/// A robot that is kinematics and noise alone (synthetic_drive.hpp). It cannot fail.
///
/// Cost    about 20 ms for ten 3 m squares.
class KinematicSource : public DriveSource {
 public:
  void check(const TrialSetup& setup) const override;
  Drives of_trial(const TrialSetup& setup, int trial) const override;
  std::vector<calibration::Trajectory> without_noise(const TrialSetup& setup) const override;
};

}  // namespace astro::simulation::study
