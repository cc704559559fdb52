#include "host/formats/cdr/message_layout.hpp"

#include <gmock/gmock.h>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/cdr/field_reader.hpp"
#include "host/formats/cdr/ros1.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/known_layouts.hpp"
#include "host/formats/messages/sensors.hpp"
#include "tests/support/base/mutations.hpp"
#include "tests/support/ros1/ros1_bag.hpp"
#include "tests/support/ros2/message_encoder.hpp"

namespace astro::ros2 {
namespace {

using ::testing::ElementsAre;

std::optional<MessageLayout> ros2msg(const std::string& text, const std::string& name = "p/msg/T") {
  return parse_definition(name, text, DefinitionFormat::ros2msg);
}
std::optional<MessageLayout> ros1msg(const std::string& text, const std::string& name = "p/T") {
  return parse_definition(name, text, DefinitionFormat::ros1msg);
}

std::vector<std::string> paths(const std::optional<MessageLayout>& layout) {
  std::vector<std::string> all;
  for (const NumberField& field : number_fields(layout.value())) all.push_back(field.path);
  return all;
}

std::vector<double> numbers(const MessageLayout& layout, ByteView message,
                            const std::vector<std::string>& of) {
  auto reader = FieldReader::of(layout, of);
  const auto* values = reader.value().read(message);
  std::vector<double> all;
  if (values != nullptr)
    for (const FieldValue& value : *values) all.push_back(value.number);
  return all;
}

msg::Odometry odometry() {
  msg::Odometry odometry;
  odometry.header = {{1'700'000'000, 123'456'789}, "odom"};
  odometry.child_frame_id = "base";
  odometry.pose.pose = {{1, 2, 3}, {4, 5, 6, 7}};
  for (std::size_t i = 0; i < 36; ++i) odometry.pose.covariance[i] = 100 + static_cast<double>(i);
  odometry.twist.twist = {{8, 9, 10}, {11, 12, 13}};
  return odometry;
}

TEST(MessageLayout, NumbersAreFoundInEitherByteOrder) {
  const auto layout = ros2msg(definition_of<msg::Odometry>(), "nav_msgs/msg/Odometry").value();
  EXPECT_EQ(stamp_field(layout), "header.stamp");
  for (const Bytes& bytes : {encode(odometry()), support::BigEndianCdr::encode(odometry())}) {
    EXPECT_THAT(numbers(layout, bytes,
                        {"pose.pose.position.y", "twist.twist.angular.z", "pose.covariance[35]",
                         "pose.pose.orientation.w"}),
                ElementsAre(2, 13, 135, 7));
    auto reader = FieldReader::of(layout, {"header.stamp"});
    EXPECT_EQ(reader.value().read(bytes)->front().time_ns, 1'700'000'000'123'456'789);
  }
}

TEST(MessageLayout, ElementsOfSequencesHaveAnIndex) {
  const auto layout = ros2msg(definition_of<msg::JointState>(), "sensor_msgs/msg/JointState").value();
  const Bytes bytes = encode(msg::JointState{{}, {"l", "right"}, {1, 2}, {3, 4}, {}});
  const std::vector<double> found = numbers(layout, bytes, {"velocity[1]", "position[0]", "effort[0]"});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0], 4);
  EXPECT_EQ(found[1], 1);
  EXPECT_TRUE(std::isnan(found[2])) << "the sequence is too short";
  EXPECT_FALSE(FieldReader::of(layout, {"position"})) << "which of them?";
  EXPECT_FALSE(FieldReader::of(layout, {"name[0]"})) << "no number";
  EXPECT_FALSE(FieldReader::of(layout, {"header"}));
  EXPECT_FALSE(FieldReader::of(layout, {"header.stamp.sec"})) << "a time is one value";
}

TEST(MessageLayout, DefinitionsMayHaveAllThatTheLanguageHas) {
  const auto layout = ros2msg(
      "# a comment\r\nuint8 LEFT=1\nuint8 RIGHT = 2 # another\nstring TEXT=a # b\n\n  int32 a 5\nint16[<=3] "
      "few [1, 2]\n"
      "string<=10 name \"x # y\"\nstring<=4[<=2] names\nfloat32[2] b\nbool c true\nOther "
      "d\nother_msgs/Far[2] e\n" +
      support::ros1::kRule + "\nMSG: p/Other\nchar f\n" + support::ros1::kRule +
      "\nMSG: other_msgs/Far\nfloat64 g\n");
  ASSERT_TRUE(layout);
  EXPECT_THAT(paths(layout), ElementsAre("a", "b[0]", "b[1]", "c", "d.f", "e[0].g", "e[1].g"));
  EXPECT_EQ(layout->types.front().fields.size(), 8U);
}

TEST(MessageLayout, WhatCannotBeLaidOutIsRefused) {
  for (const std::string text : {"Missing a\n", "T a\n", "T[] a\n", "wstring a\n", "int32\n", "int32 =\n",
                                 "int32[0] a\n", "int32[x] a\n", "int32[-1] a\n", "int8 a\nstring a\n",
                                 "int32[99999999999] a\n", "x", "module p { struct T { long a; }; };"})
    EXPECT_FALSE(ros2msg(text)) << text;
  EXPECT_FALSE(ros2msg("")) << "nothing is said";
  EXPECT_TRUE(ros1msg("")) << "std_msgs/Empty has no fields";
  std::string deep = "A0 a\n";
  for (int i = 0; i < 40; ++i)
    deep += support::ros1::kRule + "\nMSG: p/A" + std::to_string(i) + "\nA" + std::to_string(i + 1) + " a\n";
  EXPECT_FALSE(ros2msg(deep + support::ros1::kRule + "\nMSG: p/A40\nint8 a\n"));
}

/// Ten fields of ten fields of ten fields: 10^12 numbers from a few lines.
TEST(MessageLayout, ManyNumbersFromFewLinesTakeNoTime) {
  std::string text = "A0[1000000] a\n";
  for (int i = 0; i < 12; ++i) {
    text += support::ros1::kRule + "\nMSG: p/A" + std::to_string(i) + "\n";
    for (int k = 0; k < 10; ++k)
      text += (i < 11 ? "A" + std::to_string(i + 1) : "int8") + " a" + std::to_string(k) + "\n";
  }
  const auto layout = ros2msg(text).value();
  EXPECT_LE(number_fields(layout).size(), 1000U);
  Bytes bytes(1000);
  bytes[1] = 1;
  EXPECT_TRUE(numbers(layout, bytes, {"a[999999].a0.a0.a0.a0.a0.a0.a0.a0.a0.a0.a0.a9"}).empty());
  EXPECT_FALSE(cdr_from_ros1(layout, bytes));
}

TEST(MessageLayout, TypesOfRos1HaveTheNamesOfRos2) {
  EXPECT_EQ(ros2_type_name("nav_msgs/Odometry"), "nav_msgs/msg/Odometry");
  EXPECT_EQ(ros2_type_name("tf/tfMessage"), "tf2_msgs/msg/TFMessage");
  EXPECT_EQ(ros2_type_name("odd"), "odd");
}

TEST(MessageLayout, MessagesThatAreTooShortOrTooLongDoNotFit) {
  const auto layout = known_layout("turtlebot3_msgs/msg/SensorState");
  CdrWriter out;
  out.number(std::int32_t{1});
  out.number(std::uint32_t{2});
  out.string("x");
  for (int i = 0; i < 1; ++i) out.number(std::uint8_t{0});
  for (int i = 0; i < 3; ++i) out.number(1.5F);
  for (int i = 0; i < 3; ++i) out.number(std::uint8_t{1});
  out.number(std::int32_t{-7});
  out.number(std::int32_t{8});
  out.number(12.1F);
  const std::vector<std::string> of{"left_encoder", "right_encoder"};
  EXPECT_THAT(numbers(*layout, out.bytes(), of), ElementsAre(-7, 8));
  EXPECT_TRUE(numbers(*layout, ByteView(out.bytes()).first(out.bytes().size() - 1), of).empty());
  Bytes longer = out.bytes();
  longer.resize(longer.size() + 8);
  EXPECT_TRUE(numbers(*layout, longer, of).empty()) << "another version of the type";
}

template <Message M>
void expect_same_bytes(const M& message, const std::string& definition) {
  const auto layout = ros1msg(definition, std::string(M::kType));
  ASSERT_TRUE(layout) << M::kType;
  const Bytes packed = support::Ros1Message::encode(message);
  EXPECT_EQ(cdr_from_ros1(*layout, packed), encode(message)) << M::kType;
  for (std::size_t size = 0; size < packed.size(); ++size)
    EXPECT_FALSE(cdr_from_ros1(*layout, ByteView(packed).first(size))) << M::kType << " " << size;
  Bytes longer = packed;
  longer.push_back(0);
  EXPECT_FALSE(cdr_from_ros1(*layout, longer)) << M::kType;
}

TEST(Ros1, MessagesBecomeTheBytesOfRos2) {
  expect_same_bytes(odometry(), support::ros1::kOdometry);
  expect_same_bytes(odometry(), definition_of<msg::Odometry>());
  expect_same_bytes(msg::JointState{{{5, 6}, "frame"}, {"left", "r", ""}, {1, 2, 3}, {}, {4, 5, 6}},
                    support::ros1::kJointState);
  expect_same_bytes(msg::TFMessage{{{{{1, 2}, "map"}, "robot", {{1, 2, 3}, {0, 0, 0, 1}}},
                                    {{{1, 3}, "m"}, "r", {{1, 2, 4}, {0, 0, 1, 0}}}}},
                    support::ros1::kTf);
  expect_same_bytes(msg::PoseStamped{{{5, 6}, "map"}, {{1, 2, 3}, {0, 0, 0, 1}}},
                    support::ros1::kPoseStamped);
}

TEST(Ros1, TimesAndDurationsAreOfTheLanguage) {
  const auto layout = ros1msg("time at\nduration[] waits\nbool b\nint64 c\n").value();
  EXPECT_EQ(stamp_field(layout), "at");
  Bytes packed;
  append(packed, std::uint32_t{7});
  append(packed, std::uint32_t{8});
  append(packed, std::uint32_t{1});
  append(packed, std::int32_t{-1});
  append(packed, std::int32_t{9});
  append(packed, std::uint8_t{1});
  append(packed, std::int64_t{-5});
  const Bytes cdr = cdr_from_ros1(layout, packed).value();
  EXPECT_THAT(numbers(layout, cdr, {"waits[0].sec", "b", "c"}), ElementsAre(-1, 1, -5));
  EXPECT_EQ(FieldReader::of(layout, {"at"}).value().read(cdr)->front().time_ns, 7'000'000'008);
}

TEST(Ros1, EmptyMessagesDoNotGrowWithoutBound) {
  const auto layout = ros1msg("Nothing[] many\n" + support::ros1::kRule + "\nMSG: p/Nothing\n").value();
  EXPECT_TRUE(cdr_from_ros1(layout, Bytes{3, 0, 0, 0}));
  EXPECT_FALSE(cdr_from_ros1(layout, Bytes{255, 255, 255, 255}));
}

TEST(Ros1, RandomDamageNeverHarmsTheConversion) {
  constexpr unsigned kSeed = 20261126;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  support::Mutator mutator(kSeed);
  const Bytes packed = support::Ros1Message::encode(odometry()), cdr = encode(odometry());
  for (int round = 0; round < 3000; ++round) {
    const auto layout = ros1msg(mutator.text(support::ros1::kOdometry), "nav_msgs/Odometry");
    if (!layout) continue;
    const auto converted = cdr_from_ros1(*layout, mutator.bytes(packed));
    EXPECT_LE(converted ? converted->size() : 0, 200 + 16 * packed.size());
    for (const NumberField& field : number_fields(*layout)) {
      auto reader = FieldReader::of(*layout, {field.path});
      ASSERT_TRUE(reader) << field.path;
      reader->read(mutator.bytes(cdr));
    }
  }
}

}  // namespace
}  // namespace astro::ros2
