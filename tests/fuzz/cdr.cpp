// ROS 2 messages.
#include "host/ros2/cdr.hpp"
#include "host/ros2/ros_messages.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  recording::decode_odometry(input);
  recording::decode_truth(input);
  if (const auto counts = recording::decode_counts(input))
    require(recording::decode_counts(recording::encode_counts(*counts))->left == counts->left,
            "counts come back from their message");
  recording::CdrReader reader(input);
  while (reader.ok()) {
    require(reader.string().size() <= input.size(), "a string is no longer than the message");
    reader.number<double>();
    reader.number<std::uint16_t>();
  }
}

std::vector<Bytes> seeds() {
  recording::CdrWriter writer;
  writer.string("text");
  writer.number(1.0);
  writer.number(std::uint16_t{1});
  return {recording::encode_odometry({}), recording::encode_counts({1, 2, 3}), recording::encode_truth({}),
          writer.bytes()};
}

}  // namespace astro::fuzz
