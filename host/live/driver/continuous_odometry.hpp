#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/base/pose2.hpp"
#include "host/live/driver/odometry_track.hpp"
#include "host/live/driver/robot_link.hpp"

namespace astro::live {

/// The robot's odometry as one motion, whatever becomes of the link and of the robot. While the link is lost the robot goes on
/// counting, so nothing has to be done when it is back. If the robot has restarted, its odometry begins at zero: the robot is
/// then told to continue from the last pose that was seen, with a covariance that is larger by what the robot may have rolled
/// unseen. That it was carried elsewhere while it was off is not covered: nobody has measured it.
class ContinuousOdometry {
 public:
  explicit ContinuousOdometry(std::optional<calibration::OdometryErrors> errors) : track_(errors) {}

  /// A connection begins. `restarted`: the robot is known to have restarted since the last one; if not, its clock shows it.
  void begin(RobotSession& session, bool restarted);
  /// The robot's parameters have changed.
  void note_parameters(RobotSession& session);

  /// Sets the pose. Throws what the request throws: RobotRefused while the robot moves.
  void set_pose(RobotSession& session, const Pose2& pose, const calibration::Symmetric3& covariance);

  /// The next sample of telemetry. False if it is not to be published: it is older than a pose that was set, or the robot
  /// has yet to be told its last pose.
  bool take(RobotSession& session, const protocol::Telemetry& telemetry);

  /// No robot has yet to be told its last pose, which it takes only at rest.
  bool is_settled() const { return !restoring_ && !(first_ && pose_); }

  /// Of the newest sample that was taken.
  const recording::OdometrySample& sample() const { return sample_; }
  const OdometryTrack& track() const { return track_; }
  /// The last thing that happened to the pose beside motion, as a clause; "" if nothing has.
  const std::string& event() const { return event_; }

  /// A pose that somebody wanted to set and that was not.
  struct RefusedPose {
    std::string why;
    microseconds at;  // on the host's clock
  };
  void refuse(const RefusedPose& pose) { refused_pose_ = pose; }
  /// The newest one.
  const std::optional<RefusedPose>& refused_pose() const { return refused_pose_; }

 private:
  bool has_restarted(RobotSession& session, const protocol::Telemetry& telemetry) const;
  void restore(RobotSession& session, const protocol::Telemetry& telemetry);
  void put(RobotSession& session, const protocol::SetPose& pose, double theta_rad,
           const calibration::Symmetric3& covariance);
  calibration::Symmetric3 rolled_unseen(double seconds) const;

  OdometryTrack track_;
  recording::OdometrySample sample_;
  /// A pose whose request went out, and whose answer did not come: nobody knows yet whether the robot has it.
  struct Unanswered {
    Pose2 pose;
    calibration::Symmetric3 covariance;
  };
  void settle_unanswered();

  std::optional<Unanswered> unanswered_;
  std::optional<protocol::PoseGroup> pose_;  // of the newest sample; nothing before the first
  microseconds seen_at_{};                   // that sample, on the clock of the host
  std::uint64_t seen_device_us_ = 0;
  std::uint64_t ignore_until_us_ = 0;      // the robot's clock when its pose was set
  bool first_ = true, restarted_ = false;  // of the session; as begin() was told
  bool restoring_ = false;
  microseconds next_try_{};
  std::string event_;
  std::optional<RefusedPose> refused_pose_;
};

}  // namespace astro::live
