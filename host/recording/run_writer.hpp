#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "host/base/files.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/formats/messages/telemetry.hpp"
#include "host/recording/log_time.hpp"
#include "host/recording/robot_messages.hpp"
#include "host/recording/run_metadata.hpp"

namespace astro::recording {

/// Records a run while it is driven. The recording is in `<path>.part` until close() gives it its name, so
/// that a run that was cut off is never mistaken for a complete one; if the program is killed, the `.part`
/// (renamed) can be read up to about its last two seconds.
///
/// Topics  /odom nav_msgs/msg/Odometry (odom -> base_link), /wheel_counts astrolabe_msgs/msg/WheelCounts,
///         /truth geometry_msgs/msg/PoseStamped (frame truth); if the robot uses a gyro, /odom_gyro nav_msgs/msg/Odometry; if there
///         are slips, /gyro_slip astrolabe_msgs/msg/GyroSlip; if there are scans, /scan sensor_msgs/msg/LaserScan; run info as
///         Metadata "astrolabe.run". For viewers /tf and, if the run knows the robot's sizes, /joint_states and
///         /robot_description (robot_messages.hpp).
/// Times   stamps inside the messages are the robot's clock. MCAP's own times are UTC, so that viewers show
///         when it was driven and not 1970: the first message is at RunInfo::started_at, the others at their
///         distance from it by the robot's clock. Without a started_at they are the robot's clock, too.
/// Limits  the poses of invalid truth samples are not kept; between two samples of a stream the heading must
///         change by less than half a turn, or whole turns are lost.
/// Errors  astro::Error naming the file: it cannot be written, or a time is not within +-2^31 s.
class RunWriter {
 public:
  RunWriter(const std::filesystem::path& path, const RunInfo& info, bag::McapWriterOptions options = {});

  void add(const OdometrySample& sample);
  void add(const TruthSample& sample);
  void add(const lidar::Scan& scan);
  void add(const GyroPose& pose);
  void add(const GyroSlip& slip);
  /// All else that the robot measures and commands, for plots: /telemetry, beside an /odom of the same time.
  void add(const ros2::msg::Telemetry& telemetry, std::int64_t time_us);
  /// `final` replaces the info given at the start. Nothing may be added afterwards.
  void close(const RunInfo& final);

 private:
  void describe(std::uint64_t time_ns);
  bool viewers_are_due(std::int64_t time_us) const;

  PartFile file_;
  bag::McapWriter mcap_;
  RunRecord record_;
  LogTime log_time_;
  RobotMessages robot_;
  bool described_ = false;
  std::optional<std::int64_t> shown_us_;  // the last sample of which viewers have transforms and joints
  std::uint16_t odometry_ = 0, counts_ = 0, truth_ = 0, transforms_ = 0, joints_ = 0, description_ = 0;
  std::optional<std::uint16_t> scans_, telemetry_, gyro_poses_, slips_;  // from the first one on
};

}  // namespace astro::recording
