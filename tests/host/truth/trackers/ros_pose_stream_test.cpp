#include "host/truth/trackers/ros_pose_stream.hpp"

#include <gmock/gmock.h>

#include <cstdint>

#include "host/base/error.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/mutations.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/ros2/message_encoder.hpp"

namespace astro::truth {
namespace {

namespace msg = ros2::msg;
using support::ThrowsTelling;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kTime_ns = 1'700'000'000'123'456'789;
const msg::Pose kAt{{1, 2, 3}, {0, 0, 0.6, 0.8}};
const Pose3 kPose{1, 2, 3, 0, 0, 0.6, 0.8};

msg::Header header(const std::string& frame = "world") { return {msg::to_time(kTime_ns), frame}; }

msg::PoseStamped pose_stamped(const std::string& frame = "world") { return {header(frame), kAt}; }
msg::Odometry odometry(const std::string& frame = "world", const std::string& child = "robot") {
  return {header(frame), child, {kAt, {}}, {}};
}
msg::TransformStamped transform(const std::string& frame = "world", const std::string& child = "robot",
                                double x_m = 1) {
  return {header(frame), child, {{x_m, 2, 3}, kAt.orientation}};
}

template <class M>
void push(RosPoseStream& stream, const M& message) {
  stream.push(M::kType, ros2::encode(message));
}

void expect_the_pose(RosPoseStream& stream, std::string_view body) {
  const std::vector<RosPose> poses = stream.take();
  ASSERT_THAT(poses, SizeIs(1));
  EXPECT_EQ(poses[0].pose, kPose);
  EXPECT_EQ(poses[0].time_ns, kTime_ns);
  EXPECT_EQ(stream.body(), body);
  EXPECT_EQ(stream.frame(), "world");
  EXPECT_THAT(stream.bodies(), ElementsAre(body));
  EXPECT_EQ(stream.why_silent(), "");
  EXPECT_THAT(stream.take(), IsEmpty());
}

template <class M>
void expect_that_it_is_read(const M& message, std::string_view body) {
  for (const Bytes& bytes : {ros2::encode(message), support::BigEndianCdr::encode(message)}) {
    SCOPED_TRACE(std::string(M::kType) + (bytes[1] == 0 ? " big endian" : " little endian"));
    RosPoseStream stream({"/topic", "", ""});
    stream.push(M::kType, bytes);
    expect_the_pose(stream, body);
  }
}

TEST(RosPoseStream, TakesBoundedMemoryHoweverLongTheNamesOfFramesAre) {
  const auto taken = support::measured([] {
    RosPoseStream stream({"/tf", "world", "robot"});
    for (int i = 0; i < 100; ++i)
      push(stream, msg::TFMessage{{transform("world", std::to_string(i) + std::string(200'000, 'x'))}});
    push(stream, msg::TFMessage{{transform()}});
    expect_the_pose(stream, "robot");
  });
  EXPECT_TRUE(taken.ended);
  if (support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, std::size_t{8} << 20);
  }
}

TEST(RosPoseStream, GivesThePoseOfEachTypeInEitherByteOrderWithItsStamp) {
  expect_that_it_is_read(pose_stamped(), "/topic");
  expect_that_it_is_read(msg::PoseWithCovarianceStamped{header(), {kAt, {}}}, "/topic");
  expect_that_it_is_read(odometry(), "robot");
  expect_that_it_is_read(transform(), "robot");
  expect_that_it_is_read(msg::TFMessage{{transform()}}, "robot");
}

TEST(RosPoseStream, OfSeveralBodiesTheNamedOneIsTaken) {
  RosPoseStream stream({"/poses", "", "robot"});
  push(stream, transform("world", "table"));
  EXPECT_EQ(stream.why_silent(), "it knows no 'robot'; it has poses of 'table'");
  push(stream, transform("world", "robot"));
  EXPECT_THAT(stream.take(), SizeIs(1));
  EXPECT_THAT(stream.bodies(), ElementsAre("robot", "table"));
}

TEST(RosPoseStream, OfSeveralBodiesOfWhichNoneIsNamedTheFirstIsTakenAndAllAreListed) {
  RosPoseStream stream({"/tf", "", ""});
  for (int i = 0; i < 3; ++i)
    push(stream, msg::TFMessage{{transform("world", "table"), transform("world", "robot")}});
  EXPECT_THAT(stream.take(), SizeIs(3));
  EXPECT_EQ(stream.body(), "table");
  EXPECT_THAT(stream.bodies(), ElementsAre("robot", "table"));
}

TEST(RosPoseStream, PosesInAnotherFrameThanTheNamedOneAreLeftOut) {
  RosPoseStream stream({"/pose", "world", ""});
  push(stream, pose_stamped("camera"));
  EXPECT_THAT(stream.take(), IsEmpty());
  EXPECT_EQ(stream.why_silent(), "its poses are in 'camera', not in 'world'");
  push(stream, pose_stamped("/world"));
  expect_the_pose(stream, "/pose");
}

TEST(RosPoseStream, ATransformAndAFixedOneBelowItGiveThePoseOfTheRobotsCentre) {
  RosPoseStream stream({"/tf", "world", "base_link"});
  push(stream, msg::TFMessage{{{header(), "markers", {{1, 2, 0}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}}});
  EXPECT_THAT(stream.take(), IsEmpty());
  EXPECT_THAT(stream.why_silent(), HasSubstr("it knows no 'base_link'; it has transforms of 'markers'"));
  stream.push_fixed(ros2::encode(msg::TFMessage{{{header("markers"), "base_link", {{-0.5, 0, 0}, {}}}}}));
  push(stream, msg::TFMessage{{{header(), "markers", {{1, 3, 0}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}}});
  const auto poses = stream.take();
  ASSERT_THAT(poses, SizeIs(1));
  EXPECT_NEAR(poses[0].pose.x_m, 1, 1e-15);
  EXPECT_NEAR(poses[0].pose.y_m, 2.5, 1e-15);
  EXPECT_EQ(poses[0].time_ns, kTime_ns);
  EXPECT_EQ(stream.body(), "base_link");
}

TEST(RosPoseStream, SaysWhereAChainOfTransformsEnds) {
  RosPoseStream stream({"/tf", "world", "robot"});
  push(stream, msg::TFMessage{{transform("map", "robot")}});
  EXPECT_EQ(stream.why_silent(), "'robot' is not below 'world'; above it are 'map'");
  RosPoseStream fixed({"/tf", "world", "robot"});
  push(fixed, msg::TFMessage{{transform("world", "table")}});
  fixed.push_fixed(ros2::encode(msg::TFMessage{{transform("world", "robot")}}));
  EXPECT_EQ(fixed.why_silent(), "'robot' stands still in 'world': all transforms between them are fixed");
}

TEST(RosPoseStream, WhatTheRobotComputesItselfIsRefused) {
  for (const char* frame : {"odom", "/odom", "robot1/odom", "odom_combined"}) {
    RosPoseStream stream({"/odom", "", ""});
    EXPECT_THAT([&] { push(stream, odometry(frame, "base_link")); },
                ThrowsTelling(PoseProblem::in_odometry_frame, "/odom", plain_frame(frame)));
  }
  RosPoseStream named({"/tf", "odom", "base_link"}), through({"/tf", "map", "base_link"});
  EXPECT_THAT([&] { push(named, msg::TFMessage{{transform("odom", "base_link")}}); },
              ThrowsTelling(PoseProblem::in_odometry_frame, "/tf", "odom"));
  const auto push_chain = [&] {
    for (int i = 0; i < 2; ++i)
      push(through, msg::TFMessage{{transform("map", "odom"), transform("odom", "base_link")}});
  };
  EXPECT_THAT(push_chain, ThrowsTelling(PoseProblem::by_odometry_frame, "/tf", "odom"));
}

TEST(RosPoseStream, OdometryBesideTheTrackerInTfDoesNotDisturb) {
  RosPoseStream stream({"/tf", "world", "tracked"});
  push(stream, msg::TFMessage{{transform("odom", "base_link"), transform("world", "tracked")}});
  EXPECT_THAT(stream.take(), SizeIs(1));
}

TEST(RosPoseStream, MessagesThatDoNotFitTheirTypeAreCounted) {
  RosPoseStream stream({"/pose", "", ""});
  EXPECT_EQ(stream.why_silent(), "no message has come");
  Bytes cut = ros2::encode(pose_stamped());
  cut.resize(cut.size() - 8);
  stream.push(msg::PoseStamped::kType, cut);
  stream.push(msg::PoseStamped::kType, {});
  EXPECT_EQ(stream.why_silent(), "2 messages have come, and none fits its type");
  push(stream, pose_stamped());
  EXPECT_THAT(stream.take(), SizeIs(1));
}

TEST(RosPoseStream, ListsNoMoreNamesThanAPersonReads) {
  RosPoseStream stream({"/tf", "world", "robot"});
  for (int i = 0; i < 1000; ++i) push(stream, msg::TFMessage{{transform("world", "f" + std::to_string(i))}});
  EXPECT_THAT(stream.why_silent(), testing::EndsWith("and 248 more")) << "some hundred are remembered";
}

TEST(RosPoseStream, RandomDamageNeverHarmsIt) {
  constexpr unsigned kSeed = 20261124;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  support::Mutator mutator(kSeed);
  const Bytes tf = ros2::encode(
                  msg::TFMessage{{transform("world", "markers"), transform("markers", "robot")}}),
              odom = ros2::encode(odometry());
  int poses = 0, refused = 0;
  for (int i = 0; i < 5000; ++i) {
    RosPoseStream stream({"/tf", "world", "robot"});
    try {
      for (int more = 0; more < 3; ++more) {
        stream.push(msg::TFMessage::kType, mutator.bytes(tf));
        stream.push_fixed(mutator.bytes(tf));
        stream.push(msg::Odometry::kType, mutator.bytes(odom));
      }
    } catch (const Error&) {
      ++refused;
    }
    poses += static_cast<int>(stream.take().size());
    EXPECT_EQ(stream.why_silent().empty(), !stream.frame().empty());
  }
  EXPECT_GT(poses, 0) << "otherwise nothing but the decoder was tried";
  std::printf("  %d poses, %d streams refused\n", poses, refused);
}

}  // namespace
}  // namespace astro::truth
