#include "host/recording/robot_messages.hpp"

#include <string>
#include <vector>

#include "common/fixed/wrapping.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/formats/messages/text_message.hpp"

namespace astro::recording {

using ros2::RobotModel;

Bytes RobotMessages::description() const { return ros2::encode_text(model_.urdf()); }

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
  const ros2::msg::Pose base = ros2::planar_pose(sample_.x_m, sample_.y_m, sample_.theta_rad);
  std::vector<ros2::StampedPose> all{{time_ns, std::string(ros2::kOdomFrame), std::string(ros2::kBaseFrame),
                                      base.position.x, base.position.y, 0, 0, 0, base.orientation.z,
                                      base.orientation.w}};
  const auto wheel = [&](const char* name, const ros2::msg::Transform& at) {
    all.push_back({time_ns, std::string(ros2::kBaseFrame), name, at.translation.x, at.translation.y,
                   at.translation.z, at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w});
  };
  if (knows_sizes()) {
    wheel(RobotModel::kLeftWheel, model_.left_wheel(static_cast<double>(left_counts_)));
    wheel(RobotModel::kRightWheel, model_.right_wheel(static_cast<double>(right_counts_)));
  }
  return ros2::encode_tf(all);
}

Bytes RobotMessages::joints() const {
  return ros2::encode_joint_state({sample_.time_us * 1000,
                                   {RobotModel::kLeftJoint, RobotModel::kRightJoint},
                                   {static_cast<double>(left_counts_) * model_.radians_per_count,
                                    static_cast<double>(right_counts_) * model_.radians_per_count},
                                   {},
                                   {}});
}

}  // namespace astro::recording
