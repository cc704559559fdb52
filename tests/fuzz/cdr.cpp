// ROS 2 messages.
#include "host/ros2/cdr.hpp"
#include "host/ros2/ros_messages.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  ros2::decode_odometry(input);
  ros2::decode_truth(input);
  if (const auto counts = ros2::decode_counts(input))
    require(ros2::decode_counts(ros2::encode_counts(*counts))->left == counts->left,
            "counts come back from their message");
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
  return {ros2::encode_odometry({}), ros2::encode_counts({1, 2, 3}), ros2::encode_truth({}), writer.bytes()};
}

}  // namespace astro::fuzz
