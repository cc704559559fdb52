#include "host/ros2/ros_messages.hpp"

#include <cmath>
#include <limits>

#include "host/ros2/cdr.hpp"
#include "host/ros2/message_definitions.hpp"
#include "host/ros2/ros_stamp.hpp"

namespace astro::ros2 {
namespace {

constexpr RosType kOdometryType{
    "nav_msgs/msg/Odometry",
    "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
    "geometry_msgs/TwistWithCovariance twist\n" ASTRO_MSG_HEADER ASTRO_MSG_RULE
    "MSG: geometry_msgs/PoseWithCovariance\ngeometry_msgs/Pose pose\nfloat64[36] covariance\n" ASTRO_MSG_POSE
        ASTRO_MSG_RULE
    "MSG: geometry_msgs/TwistWithCovariance\ngeometry_msgs/Twist twist\nfloat64[36] "
    "covariance\n" ASTRO_MSG_TWIST};

constexpr RosType kPoseStampedType{
    "geometry_msgs/msg/PoseStamped",
    "std_msgs/Header header\ngeometry_msgs/Pose pose\n" ASTRO_MSG_HEADER ASTRO_MSG_POSE};

constexpr RosType kWheelCountsType{"astrolabe_msgs/msg/WheelCounts",
                                   "# Running encoder counts: forward is positive, each wraps at 2^32.\n"
                                   "builtin_interfaces/Time stamp\nint32 left\nint32 right\n" ASTRO_MSG_TIME};

constexpr std::int64_t kMicrosPerSecond = 1'000'000;
constexpr int kCovarianceNumbers = 36;

void put_stamp(CdrWriter& out, std::int64_t time_us) { put_time_ns(out, time_us * 1000); }

std::int64_t take_stamp(CdrReader& in) {
  // Rounded downwards, before 1970 as well.
  const std::int64_t time_ns = take_time_ns(in);
  const std::int64_t nanos = time_ns % 1000;
  return (time_ns - (nanos < 0 ? nanos + 1000 : nanos)) / 1000;
}

void put_numbers(CdrWriter& out, std::initializer_list<double> values) {
  for (const double value : values) out.number(value);
}

void put_zeros(CdrWriter& out, int count) {
  for (int i = 0; i < count; ++i) out.number(0.0);
}

void skip_numbers(CdrReader& in, int count) {
  for (int i = 0; i < count; ++i) in.number<double>();
}

void put_pose(CdrWriter& out, double x_m, double y_m, double z_m, double theta_rad) {
  const double flat = std::isnan(theta_rad) ? theta_rad : 0.0;
  put_numbers(out, {x_m, y_m, z_m, flat, flat, std::sin(theta_rad / 2), std::cos(theta_rad / 2)});
}

/// The rotation about z (swing-twist decomposition): 2 atan2(z, w), the same for q and -q.
double take_pose(CdrReader& in, double& x_m, double& y_m) {
  x_m = in.number<double>();
  y_m = in.number<double>();
  skip_numbers(in, 3);  // position z, orientation x and y
  const auto z = in.number<double>();
  const auto w = in.number<double>();
  const double half = w < 0 ? std::atan2(-z, -w) : std::atan2(z, w);
  return 2 * half;
}

}  // namespace

const RosType& odometry_type() { return kOdometryType; }
const RosType& pose_stamped_type() { return kPoseStampedType; }
const RosType& wheel_counts_type() { return kWheelCountsType; }

bool fits_stamp(std::int64_t time_us) {
  constexpr std::int64_t kEdge = (std::int64_t{1} << 31) * kMicrosPerSecond;
  return time_us >= -kEdge && time_us < kEdge;
}

Bytes encode_odometry(const recording::OdometrySample& sample) {
  CdrWriter out;
  put_stamp(out, sample.time_us);
  out.string(kOdomFrame);
  out.string(kBaseFrame);
  put_pose(out, sample.x_m, sample.y_m, 0, sample.theta_rad);
  put_zeros(out, kCovarianceNumbers);
  put_numbers(out, {sample.v_mps, 0, 0, 0, 0, sample.omega_radps});
  put_zeros(out, kCovarianceNumbers);
  return out.bytes();
}

Bytes encode_counts(const WheelCounts& counts) {
  CdrWriter out;
  put_stamp(out, counts.time_us);
  out.number(counts.left);
  out.number(counts.right);
  return out.bytes();
}

Bytes encode_truth(const recording::TruthSample& sample) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CdrWriter out;
  put_stamp(out, sample.time_us);
  out.string(kTruthFrame);
  if (sample.valid) {
    put_pose(out, sample.x_m, sample.y_m, 0, sample.theta_rad);
  } else {
    put_pose(out, kNan, kNan, kNan, kNan);
  }
  return out.bytes();
}

std::optional<recording::OdometrySample> decode_odometry(ByteView message) {
  CdrReader in(message);
  recording::OdometrySample sample;
  sample.time_us = take_stamp(in);
  in.string();
  in.string();
  sample.theta_rad = take_pose(in, sample.x_m, sample.y_m);
  skip_numbers(in, kCovarianceNumbers);
  sample.v_mps = in.number<double>();
  skip_numbers(in, 4);
  sample.omega_radps = in.number<double>();
  if (!in.ok()) return std::nullopt;
  return sample;
}

std::optional<WheelCounts> decode_counts(ByteView message) {
  CdrReader in(message);
  WheelCounts counts;
  counts.time_us = take_stamp(in);
  counts.left = in.number<std::int32_t>();
  counts.right = in.number<std::int32_t>();
  if (!in.ok()) return std::nullopt;
  return counts;
}

std::optional<recording::TruthSample> decode_truth(ByteView message) {
  CdrReader in(message);
  recording::TruthSample sample;
  sample.time_us = take_stamp(in);
  in.string();
  sample.theta_rad = take_pose(in, sample.x_m, sample.y_m);
  sample.valid = !std::isnan(sample.x_m) && !std::isnan(sample.y_m);
  if (!in.ok()) return std::nullopt;
  return sample;
}

}  // namespace astro::ros2
