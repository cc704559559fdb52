#include "host/import/bags/bag_wheels.hpp"
#include "host/import/wheels/counter_wraps.hpp"

#include <gmock/gmock.h>

#include "host/base/pose2.hpp"
#include "host/calibration/motion/arc.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/import/bags/wheel_sources.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/ros1/ros1_bag.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using ros2::CdrWriter;
using support::Tells;
using support::ThrowsTelling;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Whether the travel of both wheels from the first sample on is this.
testing::AssertionResult travels(const WheelTrack& track,
                                 const std::vector<std::array<double, 2>>& expected) {
  if (track.samples.size() != expected.size())
    return testing::AssertionFailure() << track.samples.size() << " samples";
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double left = track.samples[i].left - track.samples[0].left,
                 right = track.samples[i].right - track.samples[0].right;
    if (std::abs(left - expected[i][0]) > 1e-9 || std::abs(right - expected[i][1]) > 1e-9)
      return testing::AssertionFailure() << i << ": " << left << " " << right;
  }
  return testing::AssertionSuccess();
}

struct Sent {
  std::string topic, type, definition;
  std::int64_t time_ns = 0;  // of the recorder
  Bytes message;
};

template <class T>
Bytes number(T value) {
  CdrWriter out;
  out.number(value);
  return out.bytes();
}

Bytes sensor_state(std::int64_t time_ns, std::int32_t left, std::int32_t right) {
  CdrWriter out;
  ros2::put(out, ros2::msg::Header{ros2::msg::to_time(time_ns), ""});
  out.number(std::uint8_t{0});
  for (int i = 0; i < 3; ++i) out.number(0.5F);
  for (int i = 0; i < 3; ++i) out.number(std::uint8_t{1});
  out.number(left);
  out.number(right);
  out.number(12.0F);
  return out.bytes();
}

class BagWheels : public ::testing::Test {
 protected:
  fs::path mcap(const std::vector<Sent>& sent) const {
    Bytes file;
    bag::McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"});
    std::map<std::string, std::uint16_t> channels;
    for (const Sent& each : sent) {
      if (!channels.contains(each.topic))
        channels[each.topic] = writer.add_channel(writer.add_schema(each.type, "ros2msg", each.definition),
                                                  each.topic, "cdr", {});
      writer.write(channels[each.topic], static_cast<std::uint64_t>(each.time_ns), each.message);
    }
    writer.close();
    return saved(file, "x.mcap");
  }
  fs::path saved(const Bytes& file, const std::string& name) const {
    bag::made_bags::save(folder_.path() / name, file);
    return folder_.path() / name;
  }
  static std::vector<std::string> names(const fs::path& path) {
    std::vector<std::string> all;
    for (const WheelSource& source : wheel_sources(bag::read_bag(path).topics)) all.push_back(source.name());
    return all;
  }

  const test::TemporaryFolder folder_;
};

Sent int32(const std::string& topic, std::int64_t time_ns, std::int32_t value) {
  return {topic, "std_msgs/msg/Int32", "int32 data\n", time_ns, number(value)};
}

TEST_F(BagWheels, TwoTopicsOfCountsAreJoinedByTime) {
  // The right wheel's messages come 20 ms later; it moves by 10 counts in 100 ms.
  std::vector<Sent> sent;
  for (int i = 0; i < 4; ++i) {
    sent.push_back(int32("/left_ticks", kSecond_ns + i * 100'000'000, 100 * i));
    sent.push_back(int32("/right_ticks", kSecond_ns + i * 100'000'000 + 20'000'000, 10 * i));
  }
  const WheelTrack track = wheels_in_bag(mcap(sent));
  EXPECT_EQ(track.unit, WheelUnit::counts);
  EXPECT_EQ(track.clock, WheelClock::receipt);
  ASSERT_EQ(track.samples.size(), 3U) << "nothing is known of the right wheel before its first message";
  EXPECT_EQ(track.samples[0], (WheelSample{kSecond_ns + 100'000'000, 100, 8}));
  EXPECT_TRUE(travels(track, {{0, 0}, {100, 10}, {200, 20}}));
  EXPECT_THAT(track.remarks[0], Tells(ChoiceRemark::wheels_recognised, "/left_ticks,/right_ticks", "counts"));
  EXPECT_THAT(track.remarks[1].sentence, HasSubstr("no stamps"));
  EXPECT_THAT(track.remarks[2].sentence, HasSubstr("interpolated"));
}

TEST_F(BagWheels, CountersOfTwoTopicsAreMadeContinuousBeforeTheyAreJoined) {
  std::vector<Sent> sent;
  for (int i = 0; i < 6; ++i) {
    const auto count = [&](int start, int step) { return static_cast<std::int16_t>(start + step * i); };
    for (const auto& [topic, value] :
         {std::pair{"/lwheel", count(32'000, 500)}, {"/rwheel", count(-32'000, -400)}})
      sent.push_back({topic, "std_msgs/msg/Int16", "int16 data\n",
                      kSecond_ns + i * 50'000'000 + (topic[1] == 'r' ? 7 : 0), number(value)});
  }
  const WheelTrack track = wheels_in_bag(mcap(sent));
  ASSERT_EQ(track.samples.size(), 5U);
  EXPECT_EQ(track.samples.back().left - track.samples.front().left, 2000);
  EXPECT_NEAR(track.samples.back().right - track.samples.front().right, -1600, 1e-3);
  EXPECT_EQ(track.counter_range, 65'536) << "another drive may need it";
}

TEST_F(BagWheels, ARangeOfCountersThatTheMessagesDoNotShowCanBeStated) {
  std::vector<Sent> sent;
  for (int i = 0; i < 30; ++i)
    for (const char* topic : {"/left_ticks", "/right_ticks"})
      sent.push_back(int32(topic, kSecond_ns + i * 50'000'000, 400 * i % 7'919));
  const fs::path path = mcap(sent);
  EXPECT_EQ(support::told_by([&] { wheels_in_bag(path); }).kind, Kind(CounterProblem::range_unknown));
  BagWheelSelection selection;
  selection.counter_range = 7'919;
  const std::vector<WheelSample> samples = wheels_in_bag(path, selection).samples;
  EXPECT_EQ(samples.back().left - samples.front().left, 29 * 400);
}

TEST_F(BagWheels, AFloatNeedsAUnit) {
  std::vector<Sent> sent;
  for (int i = 0; i < 3; ++i)
    for (const char* topic : {"/left_wheel", "/right_wheel"})
      sent.push_back({topic, "std_msgs/msg/Float32", "float32 data\n", kSecond_ns * (1 + i),
                      number(static_cast<float>(90 * i))});
  const fs::path path = mcap(sent);
  EXPECT_THAT([&] { wheels_in_bag(path); }, ThrowsTelling(WheelProblem::unit_unclear, "counts", "rad", "deg",
                                                          "m", "cm", "mm", "rad/s", "rpm", "m/s"));
  BagWheelSelection selection;
  selection.measure = travel_measure("deg");
  const WheelTrack degrees = wheels_in_bag(path, selection);
  EXPECT_EQ(degrees.unit, WheelUnit::radians);
  const double quarter = std::numbers::pi / 2;
  EXPECT_TRUE(travels(degrees, {{0, 0}, {quarter, quarter}, {2 * quarter, 2 * quarter}}));
  selection.measure = travel_measure("rpm");
  const WheelTrack rpm = wheels_in_bag(path, selection);
  const double turn = 2 * std::numbers::pi;
  EXPECT_TRUE(travels(rpm, {{0, 0}, {0.75 * turn, 0.75 * turn}, {3 * turn, 3 * turn}})) << "integrated";
}

TEST_F(BagWheels, FieldsOfATypeThatTheBagDefinesAreRecognised) {
  const std::string definition =
      "std_msgs/Header header\nuint8 MODE=1\nfloat32 battery\nEncoders encoders\nint16 left_pwm\nint16 "
      "right_pwm\n" +
      support::ros1::kRule + "\nMSG: my_msgs/Encoders\nint64 leftEncoder\nint64 rightEncoder\n";
  std::vector<Sent> sent;
  for (int i = 0; i < 3; ++i) {
    CdrWriter out;
    ros2::put(out, ros2::msg::Header{ros2::msg::to_time(5 * kSecond_ns + i), "x"});
    out.number(1.0F);
    out.number(std::int64_t{7} * i);
    out.number(std::int64_t{-9} * i);
    out.number(std::int16_t{1});
    out.number(std::int16_t{2});
    sent.push_back({"/base/state", "my_msgs/msg/State", definition, kSecond_ns, out.bytes()});
  }
  const fs::path path = mcap(sent);
  const WheelTrack track = wheels_in_bag(path);
  EXPECT_EQ(track.clock, WheelClock::stamp);
  EXPECT_EQ(track.samples[2], (WheelSample{5 * kSecond_ns + 2, 14, -18}));
  EXPECT_THAT(names(path), ElementsAre("/base/state:encoders.leftEncoder,encoders.rightEncoder"));
  BagWheelSelection exchanged;
  exchanged.topic = "/base/state:encoders.rightEncoder,encoders.leftEncoder";
  EXPECT_EQ(wheels_in_bag(path, exchanged).samples[2].left, -18);
  for (const char* none : {"left", "header.stamp"}) {
    exchanged.topic = std::string("/base/state:encoders.leftEncoder,") + none;
    EXPECT_THAT([&] { wheels_in_bag(path, exchanged); },
                ThrowsTelling(WheelProblem::fields_unclear, "battery", "encoders.leftEncoder",
                              "encoders.rightEncoder", "left_pwm", "right_pwm"));
  }
}

TEST_F(BagWheels, ElementsOfASequenceOfWholeNumbersAreCounts) {
  std::vector<Sent> sent;
  for (int i = 0; i < 3; ++i) {
    CdrWriter out;
    out.number(std::uint32_t{2});
    out.number(std::int32_t{5} * i);
    out.number(std::int32_t{7} * i);
    sent.push_back({"/ticks", "my_msgs/msg/Ticks", "int32[] wheel_ticks\n", kSecond_ns + i, out.bytes()});
  }
  BagWheelSelection selection;
  selection.topic = "/ticks:wheel_ticks[0],wheel_ticks[1]";
  const WheelTrack track = wheels_in_bag(mcap(sent), selection);
  EXPECT_EQ(track.unit, WheelUnit::counts);
  EXPECT_EQ(track.samples[2].right, 14);
}

/// As recorded before Iron, without definitions.
TEST_F(BagWheels, ATurtleBotIsKnownWithoutADefinition) {
  const fs::path path = folder_.path() / "x.db3";
  {
    const bag::Database database = bag::made_bags::open(path);
    bag::made_bags::run(database, bag::made_bags::schema(2) +
                                      "INSERT INTO topics(id,name,type,serialization_format) VALUES"
                                      "(3,'/sensor_state','turtlebot3_msgs/msg/SensorState','cdr');");
    for (int i = 0; i < 3; ++i)
      bag::made_bags::add(database, 3, i, sensor_state(kSecond_ns + i, 4 * i, 5 * i));
  }
  const WheelTrack track = wheels_in_bag(path);
  EXPECT_EQ(track.samples[2], (WheelSample{kSecond_ns + 2, 8, 10}));
  EXPECT_THAT(track.remarks[0],
              Tells(ChoiceRemark::wheels_recognised, "/sensor_state:left_encoder,right_encoder", "counts"));
}

TEST_F(BagWheels, WhatIsCommandedOrMeasuredElsewhereIsNoWheel) {
  std::vector<Sent> sent;
  for (const char* topic :
       {"/left_wheel_cmd", "/right_wheel_cmd", "/left_ir_distance", "/right_ir_distance",
        "/left_motor_current", "/right_motor_current", "/left_arm_position", "/right_arm_position"})
    sent.push_back({topic, "std_msgs/msg/Float32", "float32 data\n", 1, number(1.0F)});
  const fs::path path = mcap(sent);
  EXPECT_THAT(names(path), ElementsAre());
  EXPECT_THAT([&] { wheels_in_bag(path); }, ThrowsTelling(WheelProblem::nothing_to_choose));
}

TEST_F(BagWheels, TravelIsTakenBeforeSpeedsAndSeveralAreUnclear) {
  std::vector<Sent> sent;
  const auto add = [&](const std::string& name) {
    for (int i = 0; i < 3; ++i)
      for (const std::string side : {"/left_", "/right_"})
        sent.push_back(
            {side + name, "std_msgs/msg/Float64", "float64 data\n", kSecond_ns * i, number(1.0 * i)});
  };
  add("wheel_velocity_rad_s");
  EXPECT_TRUE(travels(wheels_in_bag(mcap(sent)), {{0, 0}, {0.5, 0.5}, {2, 2}}));
  add("wheel_angle");
  EXPECT_TRUE(travels(wheels_in_bag(mcap(sent)), {{0, 0}, {1, 1}, {2, 2}}));
  add("encoder");
  EXPECT_THAT([&] { wheels_in_bag(mcap(sent)); },
              ThrowsTelling(WheelProblem::topic_unclear, "/left_encoder,/right_encoder",
                            "/left_wheel_angle,/right_wheel_angle",
                            "/left_wheel_velocity_rad_s,/right_wheel_velocity_rad_s"));
  BagWheelSelection selection;
  selection.topic = "/left_encoder,/right_encoder";
  EXPECT_EQ(wheels_in_bag(mcap(sent), selection).unit, WheelUnit::counts);
}

TEST_F(BagWheels, JointsOfAnArmDoNotHideTheWheels) {
  std::vector<Sent> sent{int32("/left_ticks", 1, 0), int32("/right_ticks", 1, 0), int32("/left_ticks", 2, 3),
                         int32("/right_ticks", 2, 4)};
  for (int i = 0; i < 2; ++i)
    sent.push_back({"/joint_states", "sensor_msgs/msg/JointState", "", i,
                    ros2::encode_joint_state({i, {"shoulder", "elbow"}, {0, 0}, {}, {}})});
  EXPECT_TRUE(travels(wheels_in_bag(mcap(sent)), {{0, 0}, {3, 4}}));
  BagWheelSelection selection;
  selection.joints = {"left", "right"};
  EXPECT_THAT([&] { wheels_in_bag(mcap(sent), selection); },
              ThrowsTelling(WheelProblem::joints_unclear, "elbow", "shoulder"));
}

TEST_F(BagWheels, FourWheelsAreTheMeansOfTheirSides) {
  const std::vector<std::string> joints{"fl", "fr", "rl", "rr"};
  std::vector<Sent> sent;
  const auto add = [&](std::int64_t time_ns, const std::vector<double>& positions) {
    sent.push_back({"/joint_states", "sensor_msgs/msg/JointState", "", time_ns,
                    ros2::encode_joint_state({time_ns, joints, positions, {}, {}})});
  };
  // The front left wheel passes the end of its turn.
  add(1, {3.0, 0, 0, 0});
  add(2, {-3.0, 0.2, 0.2, 0.4});
  add(3, {-2.8, 0.4, 0.3, 0.8});
  BagWheelSelection selection;
  selection.joints = {"fl", "fr"};
  selection.further = {{"rl", "rr"}};
  const WheelTrack track = wheels_in_bag(mcap(sent), selection);
  const double first = 2 * std::numbers::pi - 6;
  EXPECT_TRUE(travels(track, {{0, 0}, {(first + 0.2) / 2, 0.3}, {(first + 0.2 + 0.3) / 2, 0.6}}));
  EXPECT_EQ(track.joints, (JointPair{"fl", "fr"}));
  EXPECT_THAT(track.remarks.back(), Tells(WheelRemark::sides_differ, "right", "50"));
  selection.further = {{"rl", "fl"}};
  EXPECT_THAT([&] { wheels_in_bag(mcap(sent), selection); },
              ThrowsTelling(WheelProblem::joints_unclear, "fl", "fr", "rl", "rr"));
}

std::vector<Sent> odometry_of(const calibration::WheelFactors& factors,
                              std::vector<std::array<double, 2>>& travel) {
  std::vector<Sent> sent;
  Pose2 pose{1, 2, 3};
  std::array<double, 2> sum{};
  for (int i = 0; i < 60; ++i) {
    const double left_m = i < 40 ? 0.02 : -0.03, right_m = 0.02 * std::cos(0.2 * i);
    if (i > 0) {
      sum = {sum[0] + left_m, sum[1] + right_m};
      calibration::advance(pose, right_m, left_m, factors);
    }
    travel.push_back(sum);
    ros2::msg::Odometry odometry;
    odometry.header = {ros2::msg::to_time(kSecond_ns * (1 + i)), "odom"};
    odometry.child_frame_id = "base_link";
    odometry.pose.pose = ros2::planar_pose(pose.x_m, pose.y_m, pose.theta_rad);
    sent.push_back({"/odom", "nav_msgs/msg/Odometry", "", kSecond_ns * (1 + i), ros2::encode(odometry)});
  }
  return sent;
}

TEST_F(BagWheels, OdometryIsTurnedBackIntoTheWheelsThatItCameFrom) {
  for (const calibration::WheelFactors& factors :
       {calibration::WheelFactors{1, 1, 0.3}, calibration::WheelFactors{1.01, 0.98, 0.3, 0.02}}) {
    std::vector<std::array<double, 2>> travel;
    const fs::path path = mcap(odometry_of(factors, travel));
    BagWheelSelection selection;
    EXPECT_THAT([&] { wheels_in_bag(path, selection); },
                ThrowsTelling(WheelProblem::odometry_needs_sizes, "/odom"));
    selection.odometry = factors;
    const WheelTrack track = wheels_in_bag(path, selection);
    EXPECT_EQ(track.unit, WheelUnit::metres);
    EXPECT_EQ(track.clock, WheelClock::stamp);
    EXPECT_EQ(track.odometry, "/odom");
    EXPECT_TRUE(travels(track, travel));
    ASSERT_EQ(track.remarks.size(), 1U);
    EXPECT_THAT(track.remarks[0], Tells(ChoiceRemark::wheels_from_odometry, "/odom"));
  }
}

TEST_F(BagWheels, OdometryIsTakenOnlyIfThereIsNothingElse) {
  std::vector<std::array<double, 2>> travel;
  std::vector<Sent> sent = odometry_of({1, 1, 0.3}, travel);
  Sent filtered = sent[0];
  for (const char* other : {"/odometry/filtered", "/odom_gyro", "/vicon/odom", "/ground_truth/odom"}) {
    filtered.topic = other;
    sent.push_back(filtered);
  }
  EXPECT_THAT(names(mcap(sent)), ElementsAre("/odom"));
  for (int i = 0; i < 3; ++i)
    for (const char* topic : {"/left_ticks", "/right_ticks"}) sent.push_back(int32(topic, i, i));
  BagWheelSelection selection;
  selection.odometry = calibration::WheelFactors{1, 1, 0.3};
  const fs::path path = mcap(sent);
  EXPECT_EQ(wheels_in_bag(path, selection).unit, WheelUnit::counts);
  selection.topic = "/odom";
  selection.measure = travel_measure("deg");
  const WheelTrack named = wheels_in_bag(path, selection);
  EXPECT_EQ(named.odometry, "/odom") << "it was named";
  EXPECT_THAT(named.remarks.back().sentence, HasSubstr("the unit that was stated is not used"));
}

TEST_F(BagWheels, TopicsThatAreNotThereAreRefusedWithThoseThatAre) {
  std::vector<Sent> sent;
  for (int i = 0; i < 3; ++i)
    for (const char* topic : {"/left_ticks", "/right_ticks"}) sent.push_back(int32(topic, i, i));
  const fs::path path = mcap(sent);
  BagWheelSelection selection;
  for (const char* name : {"/ticks", "/left_ticks,/ticks", "/ticks:a,b", "/ticks,/right_ticks:data"}) {
    selection.topic = name;
    EXPECT_THAT([&] { wheels_in_bag(path, selection); },
                ThrowsTelling(WheelProblem::topic_unclear, "/left_ticks,/right_ticks"))
        << name;
  }
  for (const char* name :
       {"/left_ticks", "/left_ticks:data", "/left_ticks:data,data", "/left_ticks,/left_ticks"}) {
    selection.topic = name;
    EXPECT_THAT([&] { wheels_in_bag(path, selection); },
                AnyOf(ThrowsTelling(WheelProblem::fields_unclear, "data"),
                      ThrowsTelling(WheelProblem::fields_unclear, name)))
        << name;
  }
}

TEST_F(BagWheels, OfRos1AreReadLikeThoseOfRos2) {
  support::Ros1Bag made("lz4");
  made.topic(1, "/joint_states", "sensor_msgs/JointState", support::ros1::kJointState);
  made.topic(2, "/tick", "duckietown_msgs/WheelEncoderStamped",
             "Header header\nint32 data\nuint16 resolution\nuint8 type\n" + support::ros1::kHeader);
  for (int i = 0; i < 3; ++i)
    made.message(1, 100 + i,
                 support::Ros1Message::encode(ros2::msg::JointState{{ros2::msg::to_time(kSecond_ns + i), ""},
                                                                    {"wheel_left", "wheel_right"},
                                                                    {0.1 * i, 0.2 * i},
                                                                    {},
                                                                    {}}));
  const WheelTrack track = wheels_in_bag(saved(made.closed(), "x.bag"));
  EXPECT_TRUE(travels(track, {{0, 0}, {0.1, 0.2}, {0.2, 0.4}}));
  EXPECT_EQ(track.samples[0].time_ns, kSecond_ns);
}

TEST_F(BagWheels, StampsOfTwoTopicsAreUsedIfBothHaveThem) {
  const std::string definition =
      "Header header\nint32 data\nuint16 resolution\nuint8 type\n" + support::ros1::kHeader;
  support::Ros1Bag made;
  made.topic(1, "/bot/left_wheel_encoder_node/tick", "duckietown_msgs/WheelEncoderStamped", definition);
  made.topic(2, "/bot/right_wheel_encoder_node/tick", "duckietown_msgs/WheelEncoderStamped", definition);
  for (int i = 0; i < 3; ++i)
    for (const std::uint32_t topic : {1U, 2U}) {
      Bytes message;
      for (const std::uint32_t word :
           {9U, 5U, static_cast<std::uint32_t>(1000 * i), 0U, 100U * static_cast<unsigned>(i)})
        append(message, word);
      append(message, std::uint16_t{135});
      append(message, std::uint8_t{2});
      made.message(topic, 100 + i, message);
    }
  const WheelTrack track = wheels_in_bag(saved(made.closed(), "x.bag"));
  EXPECT_EQ(track.clock, WheelClock::stamp);
  EXPECT_EQ(track.samples[0].time_ns, 5 * kSecond_ns);
  EXPECT_TRUE(travels(track, {{0, 0}, {100, 100}, {200, 200}}));
}

TEST(TravelMeasure, NamesTellWhatIsMeasured) {
  const auto unit = [](const std::string& words, bool integer,
                       const std::string& context = "") -> std::string {
    const NamedMeasure named = measure_named(words, context, integer);
    return !named.of_wheel ? "no" : named.measure ? std::string(named.measure->name) : "?";
  };
  EXPECT_EQ(unit("<>encoder", true), "counts");
  EXPECT_EQ(unit("<> wheel ticks", true), "counts");
  EXPECT_EQ(unit("velocity <>", false, "irobot_create_msgs/msg/WheelVels"), "?");
  EXPECT_EQ(unit("<> wheel rpm", false), "rpm");
  EXPECT_EQ(unit("<> wheel speed m s", false), "m/s");
  EXPECT_EQ(unit("<> wheel position", false), "rad");
  EXPECT_EQ(unit("<> wheel position", true), "counts");
  EXPECT_EQ(unit("<> wheel distance mm", true), "mm");
  EXPECT_EQ(unit("<> wheel", true), "counts");
  EXPECT_EQ(unit("<> wheel dropped", true), "no");
  EXPECT_EQ(unit("<> distance", false), "no");
  EXPECT_EQ(unit("<> wheel target speed", false), "no");
}

}  // namespace
}  // namespace astro::importing
