// Messages of ROS 2 from anybody, to a stream of poses: the first byte of the input says of which type, and whether they are
// of /tf_static.
#include "host/base/error.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/truth/source/floor_track.hpp"
#include "host/truth/trackers/node_names.hpp"
#include "host/truth/trackers/ros_pose_stream.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

namespace msg = ros2::msg;

constexpr std::string_view kTypes[] = {msg::TFMessage::kType, msg::PoseStamped::kType, msg::Odometry::kType,
                                       msg::PoseWithCovarianceStamped::kType, msg::TransformStamped::kType};

void push(truth::RosPoseStream& stream, std::uint8_t kind, ByteView message) {
  if (kind == std::size(kTypes))
    stream.push_fixed(message);
  else
    stream.push(kTypes[kind], message);
}

}  // namespace

void take(ByteView input) {
  if (input.empty()) return;
  const auto kind = static_cast<std::uint8_t>(input[0] % (std::size(kTypes) + 1));
  const ByteView message = input.subspan(1);
  truth::NodeNames().take(message);
  truth::RosPoseStream stream({"/tf", "world", "robot"});
  truth::FloorTrack track(truth::UpAxis::z);
  try {
    for (int again = 0; again < 2; ++again) push(stream, kind, message);
  } catch (const Error&) {
  }
  require(stream.why_silent().empty() == !stream.frame().empty(), "a stream with poses is not silent");
  for (const truth::RosPose& pose : stream.take()) {
    const recording::TruthSample sample = track.take(pose.time_ns / 1000, pose.pose);
    require(!sample.valid || sample.x_m * sample.x_m < 1e9, "a valid sample is at a possible place");
  }
}

std::vector<Bytes> seeds() {
  const msg::Pose at{{1, 2, 3}, {0, 0, 0.6, 0.8}};
  const msg::TransformStamped upper{{{}, "world"}, "markers", {{1, 2, 3}, at.orientation}},
      lower{{{}, "markers"}, "robot", {{1, 2, 3}, at.orientation}};
  const Bytes messages[] = {ros2::encode(msg::TFMessage{{upper, lower}}),
                            ros2::encode(msg::PoseStamped{{{}, "world"}, at}),
                            ros2::encode(msg::Odometry{{{}, "world"}, "robot", {at, {}}, {}}),
                            ros2::encode(msg::PoseWithCovarianceStamped{{{}, "world"}, {at, {}}}),
                            ros2::encode(lower),
                            ros2::encode(msg::TFMessage{{lower}})};
  std::vector<Bytes> seeds;
  for (const Bytes& message : messages) {
    Bytes seed{static_cast<std::uint8_t>(seeds.size())};
    append(seed, message);
    seeds.push_back(seed);
  }
  return seeds;
}

}  // namespace astro::fuzz
