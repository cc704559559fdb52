#include "host/import/bags/pose_topics.hpp"

#include <gmock/gmock.h>

#include "host/formats/messages/stamped_pose.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/places.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using ros2::StampedPose;
using support::Tells;
using support::ThrowsTelling;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kSecond = 1'000'000'000;

class PoseTopics : public ::testing::Test {
 protected:
  /// A bag with these transforms, one message each, logged a second apart from `log_ns` on.
  fs::path bag(const std::vector<std::pair<std::string, StampedPose>>& transforms,
               std::int64_t log_ns = kSecond) const {
    const fs::path path = folder_.path() / "x.mcap";
    Bytes file;
    bag::McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"});
    const auto schema = writer.add_schema(ros2::tf_message_type().name, "ros2msg", "");
    std::map<std::string, std::uint16_t> channels;
    for (const auto& [topic, pose] : transforms) {
      if (!channels.contains(topic)) channels[topic] = writer.add_channel(schema, topic, "cdr", {});
      writer.write(channels[topic], static_cast<std::uint64_t>(log_ns), ros2::encode_tf({pose}));
      log_ns += kSecond;
    }
    writer.close();
    bag::made_bags::save(path, file);
    return path;
  }
  const test::TemporaryFolder folder_;
};

StampedPose pose(std::int64_t time_ns, const std::string& frame, const std::string& child, double x_m) {
  return {time_ns, frame, child, x_m, 0, 0, 0, 0, 0, 1};
}

std::vector<double> xs(const PoseTopic& topic) {
  std::vector<double> all;
  for (const TimedPose& at : topic.poses) all.push_back(at.x_m);
  return all;
}

TEST_F(PoseTopics, TransformsAreToldApartByTheirFrames) {
  const fs::path path = bag({{"/tf", pose(1, "map", "odom", 1)},
                             {"/tf", pose(2, "odom", "base", 2)},
                             {"/tf", pose(3, "map", "odom", 3)}});
  const std::vector<PoseStream> streams = pose_streams(path);
  ASSERT_EQ(streams.size(), 2U);
  EXPECT_EQ(streams[0].name(), "/tf map odom");
  EXPECT_EQ(streams[0].poses, 2U);
  EXPECT_THAT(xs(poses_in_bag(path, {"", "map", ""})), ElementsAre(1, 3));
  EXPECT_THAT(xs(poses_in_bag(path, {"/tf", "", "base"})), ElementsAre(2));
}

TEST_F(PoseTopics, ATopicOfATrackerIsRecognised) {
  const fs::path path =
      bag({{"/tf", pose(1, "map", "odom", 1)}, {"/vicon/tf", pose(2, "world", "robot", 2)}});
  const PoseTopic topic = poses_in_bag(path);
  EXPECT_THAT(xs(topic), ElementsAre(2));
  EXPECT_THAT(topic.remarks.at(0),
              Tells(ChoiceRemark::poses_recognised, "/vicon/tf world robot", "tf2_msgs/msg/TFMessage"));
}

TEST_F(PoseTopics, WhatIsUnclearIsRefusedWithTheChoices) {
  const fs::path path = bag({{"/tf", pose(1, "map", "odom", 1)}, {"/tf", pose(2, "odom", "base", 2)}});
  for (const PoseSelection& selection : {PoseSelection{}, PoseSelection{"/pose", "", ""}})
    EXPECT_THAT([&] { poses_in_bag(path, selection); },
                ThrowsTelling(WheelProblem::poses_unclear, "/tf map odom", "/tf odom base"));
  EXPECT_THAT([&] { poses_in_bag(bag({})); }, ThrowsTelling(WheelProblem::nothing_to_choose));
}

// Wheels that are calibrated against the odometry that was computed from them seem perfect.
TEST_F(PoseTopics, ARobotsOwnEstimatesAreNeverTruthUnlessTheyAreNamed) {
  const fs::path transform = bag({{"/tf", pose(1, "odom", "base_link", 1)}});
  EXPECT_THAT([&] { poses_in_bag(transform); },
              ThrowsTelling(WheelProblem::poses_unclear, "/tf odom base_link"))
      << "the only stream of poses";
  for (const PoseSelection& named : {PoseSelection{"/tf", "", ""}, PoseSelection{"", "odom", "base_link"}}) {
    const PoseTopic topic = poses_in_bag(transform, named);
    EXPECT_THAT(xs(topic), ElementsAre(1));
    EXPECT_THAT(topic.remarks.at(0),
                Tells(ChoiceRemark::poses_may_be_estimate, "/tf odom base_link", "tf2_msgs/msg/TFMessage"));
  }
}

TEST(PoseChoice, EstimatesAreToldByTheirTypeOrTheirName) {
  const auto estimate = [](const char* topic, const char* type) {
    return is_estimate({topic, type, "", "", 0, {}, 0, 0});
  };
  for (const char* type :
       {"nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage", "geometry_msgs/msg/PoseWithCovarianceStamped"}) {
    EXPECT_TRUE(estimate("/pose", type)) << type;
    EXPECT_TRUE(estimate("/path_tracker/pose", type)) << type;
    EXPECT_TRUE(estimate("/ground_robot/pose", type)) << type;
    EXPECT_FALSE(estimate("/ground_truth/pose", type)) << type;
    EXPECT_FALSE(estimate("/vrpn_mocap/robot/pose", type)) << type;
  }
  for (const char* topic : {"/odom_pose", "/robot/AMCL_pose", "/slam/pose", "/goal_pose"})
    EXPECT_TRUE(estimate(topic, "geometry_msgs/msg/PoseStamped")) << topic;
  EXPECT_FALSE(estimate("/tracker/pose", "geometry_msgs/msg/PoseStamped"));
}

TEST_F(PoseTopics, TimesAreStampsOrThoseOfTheRecorder) {
  const PoseTopic stamped =
      poses_in_bag(bag({{"/mocap", pose(kSecond, "a", "b", 1)}, {"/mocap", pose(2 * kSecond, "a", "b", 2)}}));
  EXPECT_TRUE(stamped.stream.stamps.most_are_set());
  EXPECT_EQ(stamped.poses[1].time_ns, 2 * kSecond);
  EXPECT_THAT(stamped.remarks, IsEmpty());
  const PoseTopic zero =
      poses_in_bag(bag({{"/mocap", pose(0, "a", "b", 1)}, {"/mocap", pose(0, "a", "b", 2)}}));
  EXPECT_FALSE(zero.stream.stamps.most_are_set());
  EXPECT_EQ(zero.poses[1].time_ns, 2 * kSecond);
  const PoseTopic other = poses_in_bag(bag(
      {{"/mocap", pose(kSecond, "a", "b", 1)}, {"/mocap", pose(5 * kSecond, "a", "b", 2)}}, 9000 * kSecond));
  ASSERT_EQ(other.remarks.size(), 2U);
  EXPECT_THAT(other.remarks[0], Tells(StampProblem::before_recorder, "8996"));
  EXPECT_THAT(other.remarks[1], Tells(StampProblem::delays_differ, "3"));
  const PoseTopic late = poses_in_bag(bag({{"/mocap", pose(2 * kSecond, "a", "b", 1)},
                                           {"/mocap", pose(3 * kSecond, "a", "b", 2)},
                                           {"/mocap", pose(1 * kSecond, "a", "b", 3)}},
                                          2 * kSecond));
  EXPECT_THAT(late.remarks, Contains(Tells(StampProblem::delays_differ, "3")))
      << "beside the remark that they were sorted";
}

TEST_F(PoseTopics, StampsAheadOfTheRecorderAreSaidToBeAfterIt) {
  const PoseTopic ahead = poses_in_bag(
      bag({{"/mocap", pose(9000 * kSecond, "a", "b", 1)}, {"/mocap", pose(9001 * kSecond, "a", "b", 2)}}));
  ASSERT_EQ(ahead.remarks.size(), 1U);
  EXPECT_THAT(ahead.remarks[0], Tells(StampProblem::after_recorder, "8999"));
}

// A node in simulated time publishes zeros until it hears the clock.
TEST_F(PoseTopics, PosesBeforeTheFirstStampAreLeftOut) {
  const PoseTopic late = poses_in_bag(bag({{"/mocap", pose(0, "a", "b", 1)},
                                           {"/mocap", pose(2 * kSecond, "a", "b", 2)},
                                           {"/mocap", pose(3 * kSecond, "a", "b", 3)}}));
  EXPECT_THAT(xs(late), ElementsAre(2, 3));
  ASSERT_EQ(late.remarks.size(), 1U);
  EXPECT_THAT(late.remarks[0], Tells(StampProblem::missing, "poses of /mocap", "1"));
  const PoseTopic once = poses_in_bag(bag({{"/mocap", pose(0, "a", "b", 1)},
                                           {"/mocap", pose(0, "a", "b", 2)},
                                           {"/mocap", pose(3 * kSecond, "a", "b", 3)}}));
  EXPECT_THAT(xs(once), ElementsAre(1, 2, 3)) << "one stamp of three";
  EXPECT_EQ(once.poses[0].time_ns, kSecond);
}

TEST(StampCount, ZeroIsATimeWhereAClockStartsWithIt) {
  const auto count = [](std::initializer_list<std::int64_t> stamps) {
    StampCount all;
    for (const std::int64_t stamp_ns : stamps) all.take(stamp_ns);
    return all;
  };
  EXPECT_FALSE(count({0, kSecond / 50, kSecond / 25}).is_missing(0));
  EXPECT_TRUE(count({0, 0, kSecond / 50, kSecond / 25}).is_missing(0)) << "no clock stands still";
  EXPECT_TRUE(count({0, 1'700'000'000 * kSecond}).is_missing(0));
  EXPECT_FALSE(count({0, 1'700'000'000 * kSecond}).is_missing(1));
  EXPECT_FALSE(count({0, 0, 5}).most_are_set());
}

TEST_F(PoseTopics, PosesOutOfOrderAreSortedAndRepeatedOnesLeftOut) {
  const PoseTopic topic = poses_in_bag(bag({{"/mocap", pose(3, "a", "b", 3)},
                                            {"/mocap", pose(1, "a", "b", 1)},
                                            {"/mocap", pose(1, "a", "b", 9)},
                                            {"/mocap", pose(2, "a", "b", 2)}}));
  EXPECT_THAT(xs(topic), ElementsAre(1, 2, 3));
}

// A run of a robot before a Vicon system, written by the Python library rosbags.
TEST_F(PoseTopics, TheTruthOfARealRunIsRecognisedInBothStorages) {
  const fs::path samples = astro::support::shared_data() / "samples/generated_by_rosbags";
  if (!fs::is_directory(samples)) GTEST_SKIP() << "no samples in " << samples;
  const PoseTopic database = poses_in_bag(samples / "qbii_sqlite3"),
                  mcap = poses_in_bag(samples / "qbii_mcap");
  EXPECT_EQ(database.stream.name(), "/vrpn_mocap/QBii/pose");
  ASSERT_EQ(database.poses.size(), 1466U);
  EXPECT_EQ(database.poses, mcap.poses);
  EXPECT_EQ(database.poses.front().time_ns, 1'650'000'000'000'000'000);  // 3 ms before the recorder's
  EXPECT_EQ(pose_streams(samples / "qbii_mcap").size(), 3U);
}

}  // namespace
}  // namespace astro::importing
