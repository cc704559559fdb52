#include "host/formats/messages/stamped_pose.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "host/formats/cdr/cdr.hpp"
#include "host/formats/cdr/codec.hpp"

namespace astro::ros2 {
namespace {

constexpr std::size_t kCovarianceCells = 36, kTwistNumbers = 6, kPoseNumbers = 7;
constexpr std::size_t kLeastTransformBytes = 2 * sizeof(std::uint32_t) + kPoseNumbers * sizeof(double);

enum class Child { absent, named };

StampedPose take_stamped_pose(CdrReader& in, Child child) {
  StampedPose pose;
  pose.time_ns = take_time_ns(in);
  pose.frame = in.name();
  if (child == Child::named) pose.child_frame = in.name();
  for (double* number : {&pose.x_m, &pose.y_m, &pose.z_m, &pose.qx, &pose.qy, &pose.qz, &pose.qw})
    *number = in.number<double>();
  return pose;
}

std::vector<StampedPose> take_transforms(CdrReader& in) {
  const std::size_t count = in.length(kLeastTransformBytes);
  std::vector<StampedPose> all(std::min(count, kMostTransforms + 1));
  for (StampedPose& pose : all) {
    if (!in.ok()) break;
    pose = take_stamped_pose(in, Child::named);
  }
  return all;
}

struct PoseType {
  std::string_view name;
  Child child;
  std::size_t further_numbers;  // behind the pose, which a whole message has
};

constexpr PoseType kPoseTypes[] = {
    {"geometry_msgs/msg/PoseStamped", Child::absent, 0},
    {"geometry_msgs/msg/PoseWithCovarianceStamped", Child::absent, kCovarianceCells},
    {"geometry_msgs/msg/TransformStamped", Child::named, 0},
    {"nav_msgs/msg/Odometry", Child::named, kCovarianceCells + kTwistNumbers + kCovarianceCells},
};

const PoseType* pose_type(std::string_view name) {
  for (const PoseType& type : kPoseTypes)
    if (type.name == name) return &type;
  return nullptr;
}

bool names_any(std::string_view topic, std::initializer_list<std::string_view> words) {
  std::string lower(topic);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::ranges::any_of(words,
                             [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

bool speaks_of_truth(std::string_view topic) {
  return names_any(topic, {"mocap", "vrpn", "optitrack", "vicon", "qualisys", "natnet", "truth"});
}

}  // namespace

const RosType& tf_message_type() {
  static const RosType type = ros_type<msg::TFMessage>();
  return type;
}

bool holds_poses(std::string_view type) {
  return type == msg::TFMessage::kType || pose_type(type) != nullptr;
}

std::optional<std::vector<StampedPose>> poses_in(std::string_view type, ByteView message) {
  CdrReader in(message);
  std::vector<StampedPose> poses;
  if (type == msg::TFMessage::kType) {
    poses = take_transforms(in);
    if (poses.size() > kMostTransforms) return std::nullopt;
  } else if (const PoseType* single = pose_type(type)) {
    poses.push_back(take_stamped_pose(in, single->child));
    in.skip<double>(single->further_numbers);
  } else {
    return std::nullopt;
  }
  if (!in.ok()) return std::nullopt;
  return poses;
}

Bytes encode_tf(const std::vector<StampedPose>& transforms) {
  msg::TFMessage message;
  message.transforms.reserve(transforms.size());
  for (const StampedPose& pose : transforms)
    message.transforms.push_back({{msg::to_time(pose.time_ns), pose.frame},
                                  pose.child_frame,
                                  {{pose.x_m, pose.y_m, pose.z_m}, {pose.qx, pose.qy, pose.qz, pose.qw}}});
  return encode(message);
}

bool speaks_of_tracker(std::string_view topic) {
  return speaks_of_truth(topic) || names_any(topic, {"tracker"});
}

bool may_be_estimate(std::string_view topic, std::string_view type) {
  if (speaks_of_truth(topic)) return false;
  return type == "nav_msgs/msg/Odometry" || type == tf_message_type().name ||
         type == "geometry_msgs/msg/PoseWithCovarianceStamped" ||
         names_any(topic, {"odom", "amcl", "slam", "ekf", "localization", "estimat", "filtered", "goal"});
}

}  // namespace astro::ros2
