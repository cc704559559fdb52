#include <gmock/gmock.h>

#include <random>

#include "host/formats/cdr/cdr.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/formats/messages/text_message.hpp"

namespace astro::ros2 {
namespace {

const StampedPose kPose{1'700'000'000'123'456'789, "map", "base", 1, -2, 3, 0.5, -0.5, 0.5, 0.5};

/// Writes CDR of either byte order, so that the reader is compared with something else than CdrWriter.
class AnyCdr {
 public:
  explicit AnyCdr(std::uint8_t kind) : bytes_{0, kind, 0, 0} {}

  template <class T>
  AnyCdr& number(T value) {
    while ((bytes_.size() - 4) % sizeof value != 0) bytes_.push_back(0xEE);
    Bytes raw;
    append(raw, value);
    if (bytes_[1] == 0) std::reverse(raw.begin(), raw.end());
    append(bytes_, raw);
    return *this;
  }
  AnyCdr& string(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    append(bytes_, as_bytes(text));
    bytes_.push_back(0);
    return *this;
  }
  AnyCdr& header() {
    return number(std::int32_t{1'700'000'000}).number(std::uint32_t{123'456'789}).string("map");
  }
  AnyCdr& pose() {
    for (const double value : {1.0, -2.0, 3.0, 0.5, -0.5, 0.5, 0.5}) number(value);
    return *this;
  }
  AnyCdr& zeros(int count) {
    for (int i = 0; i < count; ++i) number(0.0);
    return *this;
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

constexpr std::uint8_t kEncapsulations[] = {0, 1};

Bytes message(std::string_view type, std::uint8_t kind) {
  AnyCdr out(kind);
  if (type == "tf2_msgs/msg/TFMessage")
    return out.number(std::uint32_t{2}).header().string("base").pose().header().string("base").pose().bytes();
  out.header();
  if (type == "nav_msgs/msg/Odometry") return out.string("base").pose().zeros(36 + 6 + 36).bytes();
  if (type == "geometry_msgs/msg/TransformStamped") return out.string("base").pose().bytes();
  out.pose();
  if (type == "geometry_msgs/msg/PoseWithCovarianceStamped") out.zeros(36);
  return out.bytes();
}

constexpr std::string_view kTypes[] = {
    "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped",
    "geometry_msgs/msg/TransformStamped", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"};

TEST(MessagesOfOthers, EveryPoseTypeReadsTheSameInEitherByteOrder) {
  for (const std::string_view type : kTypes) {
    EXPECT_TRUE(holds_poses(type));
    for (const std::uint8_t kind : kEncapsulations) {
      const auto poses = poses_in(type, message(type, kind));
      ASSERT_TRUE(poses) << type << " " << int{kind};
      ASSERT_EQ(poses->size(), type == "tf2_msgs/msg/TFMessage" ? 2U : 1U);
      StampedPose expected = kPose;
      if (type.find("Pose") != std::string_view::npos) expected.child_frame = "";
      for (const StampedPose& pose : *poses) EXPECT_EQ(pose, expected) << type << " " << int{kind};
    }
  }
}

TEST(MessagesOfOthers, AMessageCutAtAnyByteIsNone) {
  for (const std::string_view type : kTypes) {
    const Bytes whole = message(type, 1);
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_FALSE(poses_in(type, ByteView(whole).first(size))) << type << " " << size;
  }
  const Bytes state = encode_joint_state({5, {"left", "right"}, {1, 2}, {3, 4}, {}});
  for (std::size_t size = 0; size < state.size(); ++size)
    EXPECT_FALSE(decode_joint_state(ByteView(state).first(size))) << size;
}

TEST(MessagesOfOthers, OtherTypesAndEncapsulationsHoldNoPoses) {
  EXPECT_FALSE(holds_poses("geometry_msgs/msg/Pose"));
  EXPECT_FALSE(poses_in("sensor_msgs/msg/Imu", message(kTypes[0], 1)));
  Bytes other = message(kTypes[0], 1);
  other[1] = 3;  // a parameter list
  EXPECT_FALSE(poses_in(kTypes[0], other));
}

TEST(MessagesOfOthers, ClaimsOfMillionsOfElementsTakeNoMemory) {
  for (const std::uint32_t count : {10U, 0x7FFF'FFFFU, 0xFFFF'FFFFU}) {
    EXPECT_FALSE(poses_in("tf2_msgs/msg/TFMessage", AnyCdr(1).number(count).bytes()));
    EXPECT_FALSE(decode_joint_state(AnyCdr(1).header().number(count).bytes()));
  }
  AnyCdr names(1);
  names.header().number(std::uint32_t{kMostJoints + 1});
  for (std::size_t i = 0; i <= kMostJoints; ++i) names.number(std::uint32_t{0});
  names.number(std::uint32_t{0}).number(std::uint32_t{0}).number(std::uint32_t{0});
  EXPECT_FALSE(decode_joint_state(names.bytes()));
}

TEST(MessagesOfOthers, NamesLongerThanThoseOfTopicsAreRefused) {
  for (const std::size_t longer : {0U, 1U}) {
    const std::string name(kLongestName + longer, 'a');
    EXPECT_EQ(decode_joint_state(encode_joint_state({0, {name}, {}, {}, {}})).has_value(), longer == 0);
    EXPECT_EQ(poses_in(tf_message_type().name, encode_tf({{0, name, "b", 0, 0, 0, 0, 0, 0, 1}})).has_value(),
              longer == 0);
  }
}

TEST(MessagesOfOthers, MoreTransformsThanAnyRobotHasAreRefused) {
  for (const std::size_t more : {0U, 1U})
    EXPECT_EQ(poses_in(tf_message_type().name, encode_tf(std::vector<StampedPose>(kMostTransforms + more)))
                  .has_value(),
              more == 0);
}

TEST(MessagesOfOthers, JointsComeBackFromTheirMessage) {
  const JointState state{-1, {"left_wheel_joint", "", "r"}, {1, 2, 3}, {}, {7, 8, 9}};
  EXPECT_EQ(decode_joint_state(encode_joint_state(state)), state);
  const Bytes big = AnyCdr(0)
                        .header()
                        .number(std::uint32_t{1})
                        .string("w")
                        .number(std::uint32_t{1})
                        .number(2.5)
                        .number(std::uint32_t{0})
                        .number(std::uint32_t{0})
                        .bytes();
  const auto read = decode_joint_state(big);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, (JointState{kPose.time_ns, {"w"}, {2.5}, {}, {}}));
}

TEST(MessagesOfOthers, AListThatDoesNotFitTheNamesIsRefused) {
  JointState state{0, {"l", "r"}, {1, 2, 3}, {}, {}};
  EXPECT_FALSE(decode_joint_state(encode_joint_state(state)));
}

TEST(MessagesOfOthers, TransformsAndTextComeBackFromTheirMessages) {
  EXPECT_EQ(poses_in(tf_message_type().name, encode_tf({kPose, kPose})), (std::vector{kPose, kPose}));
  EXPECT_EQ(decode_text(encode_text("<robot/>")), "<robot/>");
}

TEST(MessagesOfOthers, RandomDamageNeverHarmsTheDecoders) {
  constexpr unsigned kSeed = 20240612;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  std::vector<Bytes> seeds{encode_joint_state({5, {"left", "right"}, {1, 2}, {3, 4}, {}})};
  for (const std::string_view type : kTypes) seeds.push_back(message(type, 1));
  for (int round = 0; round < 3000; ++round) {
    Bytes bad = seeds[random() % seeds.size()];
    for (std::size_t edits = 1 + random() % 4; edits > 0; --edits)
      bad[random() % std::min<std::size_t>(bad.size(), 60)] = static_cast<std::uint8_t>(random());
    bad.resize(random() % (bad.size() + 1));
    for (const std::string_view type : kTypes)
      if (const auto poses = poses_in(type, bad)) {
        EXPECT_LE(poses->size() * 64, bad.size() + 64);
      }
    decode_joint_state(bad);
  }
}

}  // namespace
}  // namespace astro::ros2
