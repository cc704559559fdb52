#pragma once

#include <cstdint>
#include <optional>

#include "host/live/driver/odometry_geometry.hpp"
#include "host/recording/run.hpp"

namespace astro::live {

/// The robot's odometry as its telemetry shows it, and how uncertain it is (host/calibration/likelihood/pose_uncertainty.hpp).
class OdometryTrack {
 public:
  /// Without `errors`, those of an uncalibrated robot are used.
  explicit OdometryTrack(std::optional<calibration::OdometryErrors> errors) : stated_errors_(errors) {}

  /// To be called when the robot's parameters become known or change. The pose and its covariance stay.
  void set_geometry(const OdometryGeometry& geometry);

  /// To be called when the robot's pose was set: to this heading, with the covariance `start`. The robot's counts may begin
  /// again at any number.
  void restart(double heading_rad, const calibration::Symmetric3& start);

  /// Takes the next sample. False if its pose does not follow from the wheel travel, so that somebody else must have set it.
  /// The covariance then begins at zero. Precondition: set_geometry() was called.
  bool take(const recording::OdometrySample& sample);

  /// The covariance of the newest sample's (x, y, theta), in m and rad. It includes the rounding of the wheel travel to whole
  /// counts.
  calibration::Symmetric3 covariance() const;

  bool knows_geometry() const { return uncertainty_.has_value(); }
  const OdometryGeometry& geometry() const { return geometry_; }
  const calibration::OdometryErrors& errors() const { return errors_; }
  /// Counts of each wheel since the first sample; they do not wrap.
  std::int64_t left_counts() const { return left_counts_; }
  std::int64_t right_counts() const { return right_counts_; }

 private:
  bool follows(const recording::OdometrySample& sample, double right_m, double left_m) const;
  double possible_way_m(double gap_s) const;
  double possible_turn_rad(double gap_s) const;

  std::optional<calibration::OdometryErrors> stated_errors_;
  calibration::OdometryErrors errors_;
  OdometryGeometry geometry_;
  std::optional<calibration::PoseUncertainty> uncertainty_;
  std::optional<recording::OdometrySample> last_;
  std::optional<double> heading_rad_;  // nothing before the first pose
  std::int64_t left_counts_ = 0, right_counts_ = 0;
};

}  // namespace astro::live
