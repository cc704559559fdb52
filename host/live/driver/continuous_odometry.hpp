#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/base/pose2.hpp"
#include "host/live/driver/odometry_geometry.hpp"
#include "host/live/driver/robot_link.hpp"
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

  /// Takes the pose with the gyro of the same sample, if there is one, after take(). The first one is as uncertain as the wheels'
  /// pose, where it begins.
  void take_gyro(const std::optional<recording::GyroPose>& pose, protocol::GyroState state);
  /// Its covariance, as covariance().
  calibration::Symmetric3 gyro_covariance() const {
    return counts_covariance() + gyro_uncertainty_->covariance();
  }

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
  calibration::Symmetric3 counts_covariance() const;
  bool follows(const recording::OdometrySample& sample, double right_m, double left_m) const;
  double possible_way_m(double gap_s) const;
  double possible_turn_rad(double gap_s) const;

  std::optional<calibration::OdometryErrors> stated_errors_;
  calibration::OdometryErrors errors_;
  OdometryGeometry geometry_;
  std::optional<calibration::PoseUncertainty> uncertainty_;
  std::optional<calibration::GyroPoseUncertainty> gyro_uncertainty_;
  calibration::GyroPoseUncertainty::Step step_;  // of the newest sample
  std::optional<double> gyro_heading_rad_;       // nothing before the first pose since restart()
  std::optional<recording::OdometrySample> last_;
  std::optional<double> heading_rad_;  // nothing before the first pose
  std::int64_t left_counts_ = 0, right_counts_ = 0;
};

/// Keeps the robot's odometry continuous across lost links and restarts of the robot. While the link is lost the robot goes
/// on counting, so nothing has to be done when it is back. If the robot has restarted, its odometry begins at zero: the last
/// pose that was seen is then set again, and the covariance grows by what the robot may have rolled unseen. The covariance
/// does not cover a robot that was carried elsewhere while it was off, because nobody has measured that.
class ContinuousOdometry {
 public:
  explicit ContinuousOdometry(std::optional<calibration::OdometryErrors> errors) : track_(errors) {}

  /// To be called when a connection begins. `restarted`: the robot is known to have restarted since the last connection. If
  /// it is false, a restart is detected from the robot's clock and counts.
  void begin(RobotSession& session, bool restarted);
  /// To be called when the robot's parameters have changed.
  void note_parameters(RobotSession& session);

  /// Sets the pose. Throws what the request throws: RobotRefused while the robot moves.
  void set_pose(RobotSession& session, const Pose2& pose, const calibration::Symmetric3& covariance);

  /// Takes the next telemetry sample. Returns false if the sample must not be published, because it is older than a pose that
  /// was set, or because the robot's last pose is not restored yet.
  bool take(RobotSession& session, const protocol::Telemetry& telemetry);

  /// False while the last pose still has to be restored, or while it is not known yet whether it has to be. The robot takes a
  /// pose only at rest.
  bool is_settled() const { return !restoring_ && !(first_ && pose_); }

  /// The newest sample that was taken.
  const recording::OdometrySample& sample() const { return sample_; }
  const OdometryTrack& track() const { return track_; }
  /// The last change of the pose that was not motion, as a clause; "" if there was none.
  const std::string& event() const { return event_; }

  /// A request to set the pose that was refused.
  struct RefusedPose {
    std::string why;
    microseconds at;  // on the host's clock
  };
  void refuse(const RefusedPose& pose) { refused_pose_ = pose; }
  /// The newest refused request.
  const std::optional<RefusedPose>& refused_pose() const { return refused_pose_; }

 private:
  bool has_restarted(RobotSession& session, const protocol::Telemetry& telemetry) const;
  void restore(RobotSession& session, const protocol::Telemetry& telemetry);
  void put(RobotSession& session, const protocol::SetPose& pose, double theta_rad,
           const calibration::Symmetric3& covariance);
  calibration::Symmetric3 rolled_unseen(double seconds) const;

  OdometryTrack track_;
  recording::OdometrySample sample_;
  /// A pose that was sent and not acknowledged, so that it is not known yet whether the robot has taken it.
  struct Unanswered {
    Pose2 pose;
    calibration::Symmetric3 covariance;
  };
  void settle_unanswered();

  std::optional<Unanswered> unanswered_;
  std::optional<protocol::PoseGroup> pose_;  // of the newest sample; nothing before the first
  microseconds seen_at_{};                   // when that sample was seen, on the host's clock
  std::uint64_t seen_device_us_ = 0;
  std::uint64_t ignore_until_us_ = 0;      // the robot's clock when its pose was set
  bool first_ = true, restarted_ = false;  // no sample of the session yet; as begin() was told
  bool restoring_ = false;
  microseconds next_try_{};
  std::string event_;
  std::optional<RefusedPose> refused_pose_;
};

}  // namespace astro::live
