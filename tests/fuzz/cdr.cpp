// ROS 2 messages.
#include "host/formats/cdr/cdr.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/formats/messages/text_message.hpp"
#include "host/recording/sample_messages.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  recording::decode_odometry(input);
  recording::decode_truth(input);
  if (const auto counts = recording::decode_counts(input))
    require(recording::decode_counts(recording::encode_counts(*counts))->left == counts->left,
            "counts come back from their message");
  for (const char* type :
       {"geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped",
        "geometry_msgs/msg/TransformStamped", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"}) {
    if (const auto poses = ros2::poses_in(type, input))
      require(poses->size() <= 1 + input.size() / 64, "a message holds no more poses than fit into it");
  }
  if (const auto joints = ros2::decode_joint_state(input))
    require(joints->names.size() <= ros2::kMostJoints, "a robot has no more joints than that");
  ros2::decode_text(input);
  ros2::CdrReader reader(input);
  while (reader.ok()) {
    require(reader.string().size() <= input.size(), "a string is no longer than the message");
    reader.number<double>();
    reader.number<std::uint16_t>();
  }
}

std::vector<Bytes> seeds() {
  ros2::CdrWriter writer;
  writer.string("text");
  writer.number(1.0);
  writer.number(std::uint16_t{1});
  return {recording::encode_odometry({}),
          recording::encode_counts({1, 2, 3}),
          recording::encode_truth({}),
          writer.bytes(),
          ros2::encode_joint_state({1, {"l", "r"}, {1, 2}, {3, 4}, {}}),
          ros2::encode_tf({{1, "a", "b", 1, 2, 3, 0, 0, 0, 1}}),
          ros2::encode_text("x")};
}

}  // namespace astro::fuzz
