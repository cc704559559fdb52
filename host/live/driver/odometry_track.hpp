#pragma once

#include <cstdint>
#include <optional>

#include "host/live/driver/odometry_geometry.hpp"
#include "host/recording/run.hpp"

namespace astro::live {

/// The robot's odometry as its telemetry shows it, and how uncertain it is (host/calibration/likelihood/pose_uncertainty.hpp).
class OdometryTrack {
 public:
  /// Without `errors` those of an uncalibrated robot.
  explicit OdometryTrack(std::optional<calibration::OdometryErrors> errors) : stated_errors_(errors) {}

  /// The robot's parameters are known, or have changed. The pose and its covariance stay.
  void set_geometry(const OdometryGeometry& geometry);

  /// The robot's pose was set to this heading, and its counts may begin again at any number: what comes next is as uncertain
  /// as `start`.
  void restart(double heading_rad, const calibration::Symmetric3& start);

  /// The next sample. False if its pose is not where the wheels have gone: somebody else has set it. Its covariance then
  /// begins at zero. Precondition: set_geometry() was called.
  bool take(const recording::OdometrySample& sample);

  /// Of (x, y, theta) of the newest sample: m, rad. Never less than what a count of each wheel is worth.
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
