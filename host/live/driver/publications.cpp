#include "host/live/driver/publications.hpp"

#include <array>
#include <cmath>

#include "host/formats/messages/ros_messages.hpp"

namespace astro::live {
namespace {

using Matrix6 = std::array<double, 36>;

constexpr std::size_t kX = 0, kY = 1, kYaw = 5;

void put_symmetric(Matrix6& matrix, std::size_t a, std::size_t b, double value) {
  matrix[6 * a + b] = matrix[6 * b + a] = value;
}

Matrix6 unmeasured_space() {
  Matrix6 matrix{};
  for (const std::size_t i : {2U, 3U, 4U}) matrix[7 * i] = kNotMeasured;
  return matrix;
}

Matrix6 in_space(const calibration::Symmetric3& p) {
  Matrix6 matrix = unmeasured_space();
  put_symmetric(matrix, kX, kX, p.xx);
  put_symmetric(matrix, kX, kY, p.xy);
  put_symmetric(matrix, kX, kYaw, p.xt);
  put_symmetric(matrix, kY, kY, p.yy);
  put_symmetric(matrix, kY, kYaw, p.yt);
  put_symmetric(matrix, kYaw, kYaw, p.tt);
  return matrix;
}

/// The robot does not drive sideways. Its tyres slip sideways no less than along, so the sideways speed has
/// the same variance.
Matrix6 in_space(const TwistCovariance& twist) {
  Matrix6 matrix = unmeasured_space();
  put_symmetric(matrix, kX, kX, twist.vv);
  put_symmetric(matrix, kY, kY, twist.vv);
  put_symmetric(matrix, kX, kYaw, twist.vw);
  put_symmetric(matrix, kYaw, kYaw, twist.ww);
  return matrix;
}

double micro(std::int32_t value) { return 1e-6 * value; }
double fraction(int value) { return std::ldexp(value, -15); }

}  // namespace

ros2::msg::Odometry odometry(const BaseState& state, const Names& names) {
  ros2::msg::Odometry message;
  message.header = {ros2::msg::to_time(state.time_ns), names.odom_frame()};
  message.child_frame_id = names.base_frame();
  message.pose.pose = ros2::planar_pose(state.sample.x_m, state.sample.y_m, state.sample.theta_rad);
  message.pose.covariance = in_space(state.covariance);
  message.twist.twist.linear.x = state.sample.v_mps;
  message.twist.twist.angular.z = state.sample.omega_radps;
  message.twist.covariance = in_space(state.twist);
  return message;
}

ros2::msg::TFMessage transforms(const BaseState& state, const ros2::RobotModel& model, const Names& names,
                                bool with_odometry) {
  const ros2::msg::Time stamp = ros2::msg::to_time(state.time_ns);
  const ros2::msg::Pose base = ros2::planar_pose(state.sample.x_m, state.sample.y_m, state.sample.theta_rad);
  ros2::msg::TFMessage message;
  if (with_odometry)
    message.transforms.push_back({{stamp, names.odom_frame()},
                                  names.base_frame(),
                                  {{base.position.x, base.position.y, 0}, base.orientation}});
  if (!model.complete()) return message;
  const auto wheel = [&](const char* name, const ros2::msg::Transform& at) {
    message.transforms.push_back({{stamp, names.frame(ros2::kBaseFrame)}, names.frame(name), at});
  };
  wheel(ros2::RobotModel::kLeftWheel, model.left_wheel(static_cast<double>(state.left_counts)));
  wheel(ros2::RobotModel::kRightWheel, model.right_wheel(static_cast<double>(state.right_counts)));
  return message;
}

ros2::msg::TFMessage fixed_transforms(std::int64_t time_ns, const Names& names) {
  if (names.base_frame() == names.frame(ros2::kBaseFrame)) return {};
  return {{{{ros2::msg::to_time(time_ns), names.base_frame()}, names.frame(ros2::kBaseFrame), {}}}};
}

ros2::msg::JointState joints(const BaseState& state, const protocol::Telemetry& telemetry,
                             const ros2::RobotModel& model, const calibration::WheelFactors& factors) {
  const auto angle_rad = [&](std::int64_t counts) {
    return static_cast<double>(counts) * model.radians_per_count;
  };
  ros2::msg::JointState message;
  message.header.stamp = ros2::msg::to_time(state.time_ns);
  message.name = {ros2::RobotModel::kLeftJoint, ros2::RobotModel::kRightJoint};
  message.position = {angle_rad(state.left_counts), angle_rad(state.right_counts)};
  message.velocity = {micro(telemetry.wheel_speed.left_umps) / factors.c_l / model.radius_m,
                      micro(telemetry.wheel_speed.right_umps) / factors.c_r / model.radius_m};
  return message;
}

ros2::msg::BatteryState battery(std::int64_t time_ns, double voltage_V, const Names& names) {
  ros2::msg::BatteryState message;
  message.header = {ros2::msg::to_time(time_ns), names.frame(ros2::kBaseFrame)};
  message.voltage = static_cast<float>(voltage_V);
  message.present = true;
  return message;
}

ros2::msg::Telemetry telemetry(const BaseState& state, const protocol::Telemetry& from, const Names& names) {
  ros2::msg::Telemetry to;
  to.header = {ros2::msg::to_time(state.time_ns), names.frame(ros2::kBaseFrame)};
  to.mode = protocol::name(from.state.mode);
  to.faults = robot::fault_names(from.state.latched_faults);
  to.left_speed = micro(from.wheel_speed.left_umps);
  to.right_speed = micro(from.wheel_speed.right_umps);
  to.left_setpoint = micro(from.setpoint.left_umps);
  to.right_setpoint = micro(from.setpoint.right_umps);
  to.left_duty = fraction(from.duty.left);
  to.right_duty = fraction(from.duty.right);
  to.linear_speed = micro(from.twist.v_umps);
  to.yaw_rate = micro(from.twist.omega_uradps);
  to.left_counts = from.counts.left;
  to.right_counts = from.counts.right;
  to.battery_voltage = 1e-3 * from.battery.mv;
  to.segment = from.path.tag;
  to.queued_segments = from.path.queued;
  to.segment_progress = fraction(from.path.progress);
  to.cross_track_error = micro(from.path.cross_track_um);
  to.heading_error = micro(from.path.heading_error_urad);
  to.x_deviation = std::sqrt(state.covariance.xx);
  to.y_deviation = std::sqrt(state.covariance.yy);
  to.yaw_deviation = std::sqrt(state.covariance.tt);
  return to;
}

}  // namespace astro::live
