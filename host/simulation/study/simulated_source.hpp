#pragma once

#include "host/simulation/study/drive_source.hpp"

/// Studies of the simulated robot.
namespace astro::simulation {

/// The firmware on the simulated board, watched by the virtual cameras, in virtual time: motors, ramps,
/// control and encoders are the simulator's; true wheels and wheelbase, slip, and the cameras' rate and
/// errors are those of the set-up.
///
/// One robot drives all squares and circles of a trial, as an experiment would drive and record them (speeds,
/// rests, 100 Hz telemetry). If the clock is to be estimated, the cameras' times are shifted after everything
/// is recorded. As for the kinematic robot, there is no truth sample outside of the drive.
///
/// Errors  besides those of DriveSource: a wind-up, which only the kinematic robot has; counts at another
///         rate; sizes that no plan or robot allows; a robot that fails (a fault, a wheel that does not come
///         to rest).
/// Cost    about 0.2 s for ten 3 m squares.
class SimulatedSource : public simulation::study::DriveSource {
 public:
  void check(const simulation::study::TrialSetup& setup) const override;
  simulation::study::Drives of_trial(const simulation::study::TrialSetup& setup, int trial) const override;
  std::vector<calibration::Trajectory> without_noise(
      const simulation::study::TrialSetup& setup) const override;
};

}  // namespace astro::simulation
