#include "host/ros2/recorded/ros_messages.hpp"

#include <cmath>
#include <limits>

#include "host/ros2/cdr/codec.hpp"
#include "host/ros2/messages/odometry.hpp"

namespace astro::ros2 {
namespace {

constexpr std::int64_t kMicrosPerSecond = 1'000'000;
/// Our own: WheelCounts on the wire.
struct CountsMessage {
  msg::Time stamp;
  std::int32_t left = 0, right = 0;

  static constexpr std::string_view kType = "astrolabe_msgs/msg/WheelCounts";
  static constexpr std::tuple kFields{Field{&CountsMessage::stamp, "stamp"},
                                      Field{&CountsMessage::left, "left"},
                                      Field{&CountsMessage::right, "right"}};
};

msg::Time to_stamp(std::int64_t time_us) { return msg::to_time(time_us * 1000); }

/// Rounded downwards, before 1970 as well.
std::int64_t time_us_of(const msg::Time& stamp) {
  const std::int64_t time_ns = msg::nanoseconds(stamp), nanos = time_ns % 1000;
  return (time_ns - (nanos < 0 ? nanos + 1000 : nanos)) / 1000;
}

}  // namespace

const RosType& odometry_type() {
  static const RosType type = ros_type<msg::Odometry>();
  return type;
}
const RosType& pose_stamped_type() {
  static const RosType type = ros_type<msg::PoseStamped>();
  return type;
}
const RosType& wheel_counts_type() {
  static const RosType type = ros_type<CountsMessage>();
  return type;
}

bool fits_stamp(std::int64_t time_us) {
  constexpr std::int64_t kEdge = (std::int64_t{1} << 31) * kMicrosPerSecond;
  return time_us >= -kEdge && time_us < kEdge;
}

msg::Pose planar_pose(double x_m, double y_m, double theta_rad) {
  const double flat = std::isnan(theta_rad) ? theta_rad : 0.0;
  return {{x_m, y_m, 0}, {flat, flat, std::sin(theta_rad / 2), std::cos(theta_rad / 2)}};
}

/// Swing-twist decomposition: 2 atan2(z, w), the same for q and -q.
double heading_of(const msg::Quaternion& q) {
  return 2 * (q.w < 0 ? std::atan2(-q.z, -q.w) : std::atan2(q.z, q.w));
}

Bytes encode_odometry(const recording::OdometrySample& sample) {
  msg::Odometry message;
  message.header = {to_stamp(sample.time_us), std::string(kOdomFrame)};
  message.child_frame_id = kBaseFrame;
  message.pose.pose = planar_pose(sample.x_m, sample.y_m, sample.theta_rad);
  message.twist.twist.linear.x = sample.v_mps;
  message.twist.twist.angular.z = sample.omega_radps;
  return encode(message);
}

Bytes encode_counts(const WheelCounts& counts) {
  return encode(CountsMessage{to_stamp(counts.time_us), counts.left, counts.right});
}

Bytes encode_truth(const recording::TruthSample& sample) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  msg::PoseStamped message;
  message.header = {to_stamp(sample.time_us), std::string(kTruthFrame)};
  message.pose = sample.valid ? planar_pose(sample.x_m, sample.y_m, sample.theta_rad)
                              : msg::Pose{{kNan, kNan, kNan}, {kNan, kNan, kNan, kNan}};
  return encode(message);
}

std::optional<recording::OdometrySample> decode_odometry(ByteView bytes) {
  const auto message = decode<msg::Odometry>(bytes);
  if (!message) return std::nullopt;
  recording::OdometrySample sample;
  const msg::Pose& pose = message->pose.pose;
  sample.time_us = time_us_of(message->header.stamp);
  sample.x_m = pose.position.x;
  sample.y_m = pose.position.y;
  sample.theta_rad = heading_of(pose.orientation);
  sample.v_mps = message->twist.twist.linear.x;
  sample.omega_radps = message->twist.twist.angular.z;
  return sample;
}

std::optional<WheelCounts> decode_counts(ByteView bytes) {
  const auto message = decode<CountsMessage>(bytes);
  if (!message) return std::nullopt;
  return WheelCounts{time_us_of(message->stamp), message->left, message->right};
}

std::optional<recording::TruthSample> decode_truth(ByteView bytes) {
  const auto message = decode<msg::PoseStamped>(bytes);
  if (!message) return std::nullopt;
  recording::TruthSample sample;
  sample.time_us = time_us_of(message->header.stamp);
  sample.x_m = message->pose.position.x;
  sample.y_m = message->pose.position.y;
  sample.theta_rad = heading_of(message->pose.orientation);
  sample.valid = !std::isnan(sample.x_m) && !std::isnan(sample.y_m);
  return sample;
}

}  // namespace astro::ros2
