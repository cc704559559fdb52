#pragma once

#include <optional>

#include "host/base/bytes.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/lidar/scan.hpp"
#include "host/recording/run.hpp"

/// The samples of a run as ROS 2 messages. Times are the robot's clock in `header.stamp`, which takes +-2^31 s and whole
/// nanoseconds.
namespace astro::recording {

/// Running encoder counts at one instant. No ROS type holds integer counts that wrap, so this type is our
/// own.
struct WheelCounts {
  std::int64_t time_us = 0;
  std::int32_t left = 0, right = 0;
};

const ros2::RosType& wheel_counts_type();  // astrolabe_msgs/msg/WheelCounts: stamp, left, right
const ros2::RosType& gyro_slip_type();     // astrolabe_msgs/msg/GyroSlip: stamp, turn_rad
const ros2::RosType& laser_scan_type();    // sensor_msgs/msg/LaserScan

Bytes encode_odometry(const OdometrySample& sample);  // all but the counts and the gyro's pose
Bytes encode_gyro_pose(const GyroPose& pose);         // as odometry whose only twist is the yaw rate
Bytes encode_counts(const WheelCounts& counts);
Bytes encode_slip(const GyroSlip& slip);
/// A sample that is not valid becomes a pose of NaNs, which viewers draw as a gap; a valid one whose heading
/// is NaN becomes a position with an orientation of NaNs.
Bytes encode_truth(const TruthSample& sample);
/// Angles, limits and the time between beams become floats, as in any LaserScan. The frame is "laser".
Bytes encode_scan(const lidar::Scan& scan);

/// Nothing if the message is too short for its type. theta is in (-pi, pi]; orientations that are not planar
/// are reduced to their rotation about z, whatever the sign of the quaternion.
std::optional<OdometrySample> decode_odometry(ByteView message);
std::optional<GyroPose> decode_gyro_pose(ByteView message);
std::optional<WheelCounts> decode_counts(ByteView message);
std::optional<GyroSlip> decode_slip(ByteView message);
std::optional<TruthSample> decode_truth(ByteView message);
std::optional<lidar::Scan> decode_scan(ByteView message);

}  // namespace astro::recording
