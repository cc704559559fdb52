#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

/// How one measure of the robot's turn follows another: a regression whose errors a Kalman filter whitens.
///
///   response = phase + x . (turn, rate, way) + drift x time + gyro's random walk + random walk by slip + reading error
///
/// The filter's states are the phase with both walks, and the drift, which walks as well; it runs over the response and over each
/// regressor alike, so that the innovations are a regression with independent errors (Harvey 1989, 3.4.2). The noise is that of
/// restricted maximum likelihood under a weak prior about what such sensors have. Noise of a regressor pulls its coefficient to zero,
/// so the regressor is the measure with less of it from one sample to the next: the wheels where the gyro is the response, because slip
/// turns the robot and not the wheels; the gyro where a tracker is the response, because each pose of it has a reading error.
namespace astro::calibration {

/// The regressors: the turn; the robot's yaw rate, whose coefficient shows what both clocks are apart; and the way, on which wheels
/// turn the robot if their ratio is off.
enum TurnColumn { kTurn, kRate, kWay, kTurnColumns };
using TurnVector = Eigen::Matrix<double, kTurnColumns, 1>;
using TurnMatrix = Eigen::Matrix<double, kTurnColumns, kTurnColumns>;

struct TurnSample {
  double time_s = 0;
  double response_rad = 0;
  TurnVector regressors = TurnVector::Zero();
  double path_m = 0;       // rolled by both wheels since the start of the drive
  bool new_phase = false;  // what was turned since the sample before is not known
};

/// Variances of the response.
struct TurnNoise {
  double gyro_rad2ps = 0;   // angle random walk, per second
  double bias_rad2ps3 = 0;  // of the bias's walk, per second
  double slip_rad2pm = 0;   // the reference's walk for each metre that both wheels rolled
  double reading_rad2 = 0;  // of each of the reference's headings
};
/// Which of them are estimated: those whose prior deviation (of the logarithm) is above 0.
struct TurnNoisePrior {
  TurnNoise middle, log_deviation;
};

struct DriveDrift {
  double radps = 0, se_radps = 0;  // at the end of the drive
};

struct TurnRegression {
  TurnVector x = TurnVector::Zero();
  TurnMatrix covariance = TurnMatrix::Zero();
  TurnNoise noise;
  std::vector<DriveDrift> drifts;  // of each drive
  double chi_square = 0;
  int degrees_of_freedom = 0;
};

/// `information`: what is known of the coefficients about 0 beforehand. Samples that are off by more than six deviations start a new
/// phase: a slip, or a reference that went wrong. They are marked so in `drives`.
/// Precondition: a sample that goes on from another one. With few samples the noise is that of the prior.
/// Cost  about 60 passes over the samples.
TurnRegression regress_turns(std::span<std::vector<TurnSample>> drives, const TurnVector& information,
                             const TurnNoisePrior& prior);

}  // namespace astro::calibration
