#include "host/recording/sample_messages.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/sensors.hpp"

namespace astro::recording {
namespace {

/// Our own message type for WheelCounts.
struct CountsMessage {
  ros2::msg::Time stamp;
  std::int32_t left = 0, right = 0;

  static constexpr std::string_view kType = "astrolabe_msgs/msg/WheelCounts";
  static constexpr std::tuple kFields{ros2::Field{&CountsMessage::stamp, "stamp"},
                                      ros2::Field{&CountsMessage::left, "left"},
                                      ros2::Field{&CountsMessage::right, "right"}};
};

/// Our own message type for GyroSlip.
struct SlipMessage {
  ros2::msg::Time stamp;
  double turn_rad = 0;

  static constexpr std::string_view kType = "astrolabe_msgs/msg/GyroSlip";
  static constexpr std::tuple kFields{ros2::Field{&SlipMessage::stamp, "stamp"},
                                      ros2::Field{&SlipMessage::turn_rad, "turn_rad"}};
};

ros2::msg::Time to_stamp(std::int64_t time_us) { return ros2::msg::to_time(time_us * 1000); }

/// Rounded downwards, before 1970 as well.
std::int64_t time_us_of(const ros2::msg::Time& stamp) {
  const std::int64_t time_ns = ros2::msg::nanoseconds(stamp), nanos = time_ns % 1000;
  return (time_ns - (nanos < 0 ? nanos + 1000 : nanos)) / 1000;
}

}  // namespace

const ros2::RosType& wheel_counts_type() {
  static const ros2::RosType type = ros2::ros_type<CountsMessage>();
  return type;
}

const ros2::RosType& gyro_slip_type() {
  static const ros2::RosType type = ros2::ros_type<SlipMessage>();
  return type;
}

const ros2::RosType& laser_scan_type() {
  static const ros2::RosType type = ros2::ros_type<ros2::msg::LaserScan>();
  return type;
}

Bytes encode_odometry(const OdometrySample& sample) {
  ros2::msg::Odometry message;
  message.header = {to_stamp(sample.time_us), std::string(ros2::kOdomFrame)};
  message.child_frame_id = ros2::kBaseFrame;
  message.pose.pose = ros2::planar_pose(sample.x_m, sample.y_m, sample.theta_rad);
  message.twist.twist.linear.x = sample.v_mps;
  message.twist.twist.angular.z = sample.omega_radps;
  return ros2::encode(message);
}

Bytes encode_gyro_pose(const GyroPose& pose) {
  return encode_odometry({.time_us = pose.time_us,
                          .x_m = pose.x_m,
                          .y_m = pose.y_m,
                          .theta_rad = pose.theta_rad,
                          .omega_radps = pose.omega_radps});
}

Bytes encode_counts(const WheelCounts& counts) {
  return ros2::encode(CountsMessage{to_stamp(counts.time_us), counts.left, counts.right});
}

Bytes encode_slip(const GyroSlip& slip) {
  return ros2::encode(SlipMessage{to_stamp(slip.time_us), slip.turn_rad});
}

Bytes encode_truth(const TruthSample& sample) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  ros2::msg::PoseStamped message;
  message.header = {to_stamp(sample.time_us), std::string(ros2::kTruthFrame)};
  message.pose = sample.valid ? ros2::planar_pose(sample.x_m, sample.y_m, sample.theta_rad)
                              : ros2::msg::Pose{{kNan, kNan, kNan}, {kNan, kNan, kNan, kNan}};
  return ros2::encode(message);
}

Bytes encode_scan(const lidar::Scan& scan) {
  const auto beams = static_cast<double>(scan.ranges_m.size());
  ros2::msg::LaserScan message;
  message.header = {ros2::msg::to_time(scan.time_ns), "laser"};
  message.angle_min = static_cast<float>(scan.first_angle_rad);
  message.angle_max = static_cast<float>(scan.first_angle_rad + (beams - 1) * scan.angle_step_rad);
  message.angle_increment = static_cast<float>(scan.angle_step_rad);
  message.time_increment = static_cast<float>(scan.beam_interval_s);
  message.scan_time = static_cast<float>(beams * scan.beam_interval_s);
  message.range_min = static_cast<float>(scan.range_min_m);
  message.range_max = static_cast<float>(scan.range_max_m);
  message.ranges = scan.ranges_m;
  return ros2::encode(message);
}

std::optional<OdometrySample> decode_odometry(ByteView bytes) {
  const auto message = ros2::decode<ros2::msg::Odometry>(bytes);
  if (!message) return std::nullopt;
  OdometrySample sample;
  const ros2::msg::Pose& pose = message->pose.pose;
  sample.time_us = time_us_of(message->header.stamp);
  sample.x_m = pose.position.x;
  sample.y_m = pose.position.y;
  sample.theta_rad = ros2::heading_of(pose.orientation);
  sample.v_mps = message->twist.twist.linear.x;
  sample.omega_radps = message->twist.twist.angular.z;
  return sample;
}

std::optional<GyroPose> decode_gyro_pose(ByteView bytes) {
  const auto sample = decode_odometry(bytes);
  if (!sample) return std::nullopt;
  return GyroPose{sample->time_us, sample->x_m, sample->y_m, sample->theta_rad, sample->omega_radps};
}

std::optional<GyroSlip> decode_slip(ByteView bytes) {
  const auto message = ros2::decode<SlipMessage>(bytes);
  if (!message) return std::nullopt;
  return GyroSlip{time_us_of(message->stamp), message->turn_rad};
}

std::optional<WheelCounts> decode_counts(ByteView bytes) {
  const auto message = ros2::decode<CountsMessage>(bytes);
  if (!message) return std::nullopt;
  return WheelCounts{time_us_of(message->stamp), message->left, message->right};
}

std::optional<TruthSample> decode_truth(ByteView bytes) {
  const auto message = ros2::decode<ros2::msg::PoseStamped>(bytes);
  if (!message) return std::nullopt;
  TruthSample sample;
  sample.time_us = time_us_of(message->header.stamp);
  sample.x_m = message->pose.position.x;
  sample.y_m = message->pose.position.y;
  sample.theta_rad = ros2::heading_of(message->pose.orientation);
  sample.valid = !std::isnan(sample.x_m) && !std::isnan(sample.y_m);
  return sample;
}

std::optional<lidar::Scan> decode_scan(ByteView bytes) {
  auto message = ros2::decode<ros2::msg::LaserScan>(bytes);
  if (!message) return std::nullopt;
  return lidar::Scan{ros2::msg::nanoseconds(message->header.stamp),
                     static_cast<double>(message->angle_min),
                     static_cast<double>(message->angle_increment),
                     static_cast<double>(message->time_increment),
                     static_cast<double>(message->range_min),
                     static_cast<double>(message->range_max),
                     std::move(message->ranges)};
}

}  // namespace astro::recording
