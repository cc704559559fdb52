#include "host/recording/files/robot_messages.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "common/fixed/wrapping.hpp"
#include "host/base/text/numbers.hpp"
#include "host/ros2/recorded/joint_state.hpp"
#include "host/ros2/recorded/ros_messages.hpp"
#include "host/ros2/recorded/stamped_pose.hpp"
#include "host/ros2/recorded/text_message.hpp"

namespace astro::recording {
namespace {

constexpr const char* kLeftWheel = "left_wheel";
constexpr const char* kRightWheel = "right_wheel";
constexpr const char* kLeftJoint = "left_wheel_joint";
constexpr const char* kRightJoint = "right_wheel_joint";

double parameter(const RunInfo& info, const char* name) {
  const auto found = info.parameters.find(name);
  return found == info.parameters.end() || !std::isfinite(found->second) ? 0 : found->second;
}

std::string wheel_link(const char* name, double radius_m) {
  return "<link name=\"" + std::string(name) + "\"><visual><origin rpy=\"" + to_text(std::numbers::pi / 2) +
         " 0 0\"/><geometry><cylinder radius=\"" + to_text(radius_m) + "\" length=\"" +
         to_text(radius_m / 2) + "\"/></geometry></visual></link>";
}

std::string wheel_joint(const char* name, const char* child, double y_m, double radius_m) {
  return "<joint name=\"" + std::string(name) + "\" type=\"continuous\"><parent link=\"" +
         std::string(ros2::kBaseFrame) + "\"/><child link=\"" + child + "\"/><origin xyz=\"0 " +
         to_text(y_m) + " " + to_text(radius_m) + "\"/><axis xyz=\"0 1 0\"/></joint>";
}

}  // namespace

RobotMessages::RobotMessages(const RunInfo& info)
    : radius_m_(parameter(info, "wheel_diameter") / 2), separation_m_(parameter(info, "b")) {
  const double counts_per_turn = parameter(info, "counts_per_motor_rev") * parameter(info, "gear_numerator") /
                                 parameter(info, "gear_denominator");
  if (std::isfinite(counts_per_turn) && counts_per_turn > 0)
    radians_per_count_ = 2 * std::numbers::pi / counts_per_turn;
}

Bytes RobotMessages::description() const {
  // The axle is above the origin of base_link, which is on the floor between the wheels.
  const std::string body = "<link name=\"" + std::string(ros2::kBaseFrame) + "\"><visual><origin xyz=\"0 0 " +
                           to_text(1.5 * radius_m_) + "\"/><geometry><box size=\"" + to_text(separation_m_) +
                           " " + to_text(0.8 * separation_m_) + " " + to_text(radius_m_) +
                           "\"/></geometry></visual></link>";
  return ros2::encode_text("<?xml version=\"1.0\"?><robot name=\"robot\">" + body +
                           wheel_link(kLeftWheel, radius_m_) + wheel_link(kRightWheel, radius_m_) +
                           wheel_joint(kLeftJoint, kLeftWheel, separation_m_ / 2, radius_m_) +
                           wheel_joint(kRightJoint, kRightWheel, -separation_m_ / 2, radius_m_) + "</robot>");
}

void RobotMessages::advance(const OdometrySample& sample) {
  if (any_) {
    left_counts_ += wrapping_difference(sample.left_counts, sample_.left_counts);
    right_counts_ += wrapping_difference(sample.right_counts, sample_.right_counts);
  }
  any_ = true;
  sample_ = sample;
}

Bytes RobotMessages::transforms() const {
  const std::int64_t time_ns = sample_.time_us * 1000;
  std::vector<ros2::StampedPose> all{{time_ns, std::string(ros2::kOdomFrame), std::string(ros2::kBaseFrame),
                                      sample_.x_m, sample_.y_m, 0, 0, 0, std::sin(sample_.theta_rad / 2),
                                      std::cos(sample_.theta_rad / 2)}};
  const auto wheel = [&](const char* name, double y_m, std::int64_t counts) {
    const double half_rad = static_cast<double>(counts) * radians_per_count_ / 2;
    all.push_back({time_ns, std::string(ros2::kBaseFrame), name, 0, y_m, radius_m_, 0, std::sin(half_rad), 0,
                   std::cos(half_rad)});
  };
  if (knows_sizes()) {
    wheel(kLeftWheel, separation_m_ / 2, left_counts_);
    wheel(kRightWheel, -separation_m_ / 2, right_counts_);
  }
  return ros2::encode_tf(all);
}

Bytes RobotMessages::joints() const {
  return ros2::encode_joint_state({sample_.time_us * 1000,
                                   {kLeftJoint, kRightJoint},
                                   {static_cast<double>(left_counts_) * radians_per_count_,
                                    static_cast<double>(right_counts_) * radians_per_count_},
                                   {},
                                   {}});
}

}  // namespace astro::recording
