#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "host/calibration/likelihood/huber.hpp"
#include "host/calibration/likelihood/moves.hpp"
#include "host/calibration/likelihood/noise_slope.hpp"
#include "host/calibration/likelihood/sample_selection.hpp"
#include "host/calibration/likelihood/unknowns.hpp"
#include "host/calibration/motion/trajectory.hpp"

/// A drive as the innovations of the Kalman filter, with their derivatives by every unknown.
///
/// The state is the robot's pose in the tracker's frame. Between two truth samples it moves by the exact arc
/// of the wheels' travel, with noise of variance K * |travel| per wheel; a truth sample is the pose of the
/// tracked body. With the right parameters the innovations are white and have the covariance that the filter
/// computes, so their weighted sum of squares is, up to terms that hardly depend on the parameters, -2 log
/// likelihood of the whole drive.
///
/// The Jacobian of the state is propagated beside the state while the gains are held fixed: that is exact for
/// the linearised filter, and one pass gives all derivatives.
namespace astro::calibration {

/// Sums over the innovations while the robot moved in one way.
struct MotionTotals {
  int samples = 0;
  double sum_xy_m2 = 0, sum_theta_rad2 = 0, chi_square = 0;
};

struct InnovationSums {
  Information information = Information::Zero();  // sum of J' S^-1 J
  Unknowns gradient = Unknowns::Zero();           // sum of J' S^-1 r
  double cost = 0;                                // -2 log likelihood, with Huber's loss, up to a constant
  double chi_square = 0;
  int degrees_of_freedom = 0;
  int session = 0;                       // PreparedRun::session
  std::array<MotionTotals, 4> motion{};  // by Motion
};

/// Averages several passes along one run. Precondition: at least one pass.
InnovationSums mean_of(std::span<const InnovationSums> passes);

/// One pass of the filter along a run.
InnovationSums innovations(const Moves& moves, const NoiseModel& noise, RobustMode robust = RobustMode::none,
                           const SampleSelection& samples = {});

/// The same, and from the same pass the slope of the likelihood by the noise.
std::pair<InnovationSums, NoiseSlope> innovations_and_noise(const Moves& moves, const NoiseModel& noise,
                                                            RobustMode robust = RobustMode::none,
                                                            const SampleSelection& samples = {});

/// The same, and the sums of innovations_by_stretch.
struct NoisePass {
  InnovationSums sums;
  std::vector<InnovationSums> stretches;
  NoiseSlope slope;
};
NoisePass innovations_and_noise(const Moves& moves, const NoiseModel& noise, RobustMode robust,
                                const SampleSelection& samples, int stretches);

/// One pass with separate sums for each of `stretches` stretches of the run, which have equal path lengths of the wheels. They
/// add up to those of the whole run. Only their information and gradient are computed.
std::vector<InnovationSums> innovations_by_stretch(const Moves& moves, const NoiseModel& noise,
                                                   RobustMode robust, const SampleSelection& samples,
                                                   int stretches);

/// The innovations in order, each in the robot's axes (ahead, left, heading), whitened by the covariance that
/// the filter expects, so that the components are independent with variance 1. Without headings the last
/// component is 0.
std::vector<Eigen::Vector3d> standardised_innovations(const Moves& moves, const NoiseModel& noise,
                                                      RobustMode robust, const SampleSelection& samples);

/// The Fisher information of a run with exactly these unknowns. Only the times of its truth samples matter.
Information expected_information(const Moves& moves, const NoiseModel& noise,
                                 const SampleSelection& samples = {});

}  // namespace astro::calibration
