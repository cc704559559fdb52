#include <gmock/gmock.h>

#include "host/formats/messages/stamped_pose.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/places.hpp"

// Bags that other programs wrote, beside a developer's checkout. The figures come from the command sqlite3 and from the
// metadata.yaml of the recorders.
namespace astro::bag {
namespace {

using namespace made_bags;  // NOLINT(google-build-using-namespace): its names are about bags alone
using ::testing::ElementsAre;

class BagSamples : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(folder_)) GTEST_SKIP() << "no samples in " << folder_;
  }
  Seen whole(const std::string& name) const {
    Seen seen = read(folder_ / name);
    EXPECT_FALSE(seen.report.truncated || seen.report.damaged) << name;
    EXPECT_TRUE(seen.report.warnings.empty()) << name;
    return seen;
  }
  const fs::path folder_ = astro::support::shared_data() / "samples";
};

TEST_F(BagSamples, ABagOfHumbleReads) {
  for (const char* name : {"rosbag2/humble_cdr_test", "rosbag2/humble_cdr_test/cdr_test_0.db3"})
    EXPECT_THAT(whole(name).report.topics,
                ElementsAre(BagTopic{"/test_topic", "test_msgs/msg/BasicTypes", "cdr", 3, 1586406456763032325,
                                     1586406456863382628},
                            BagTopic{"/array_topic", "test_msgs/msg/Arrays", "cdr", 4, 1586406456782683500,
                                     1586406456914169506}));
}

TEST_F(BagSamples, ADatabaseWithoutMetadataReads) {
  const Seen seen = whole("rosbag2/schema4_topics_services");
  ASSERT_EQ(seen.report.topics.size(), 5U);
  EXPECT_EQ(seen.report.topics[0].messages, 7U);
  EXPECT_EQ(seen.report.topics[3].messages, 6U);
  EXPECT_EQ(seen.messages.size(), 13U);
}

TEST_F(BagSamples, TransformsOfABagRead) {
  std::map<std::string, int> pairs;
  BagHandlers handlers;
  handlers.message = [&](const BagTopic& topic, const BagMessage& message) {
    const auto poses = ros2::poses_in(topic.type, message.data);
    ASSERT_TRUE(poses);
    for (const ros2::StampedPose& pose : *poses) {
      ++pairs[topic.name + " " + pose.frame + ">" + pose.child_frame];
      EXPECT_NEAR(pose.qx * pose.qx + pose.qy * pose.qy + pose.qz * pose.qz + pose.qw * pose.qw, 1, 1e-9);
    }
  };
  read_bag(folder_ / "rosbag2/tf_example", handlers);
  int all = 0;
  for (const auto& [pair, count] : pairs) all += count;
  EXPECT_EQ(all, 518);
  EXPECT_EQ(pairs["/tf odom>base_footprint"], 517);
}

// The same run, written by the Python library rosbags in both storages.
TEST_F(BagSamples, TheSameRunReadsTheSameFromBothStorages) {
  std::map<std::string, std::vector<std::string>> databases, mcaps;
  const auto by_topic = [&](const std::string& name) {
    std::map<std::string, std::vector<std::string>> all;
    for (const std::string& message : whole("generated_by_rosbags/" + name).messages)
      all[message.substr(0, message.find(' '))].push_back(message);
    return all;
  };
  const auto database = by_topic("qbii_sqlite3"), mcap = by_topic("qbii_mcap");
  EXPECT_EQ(database, mcap);
  EXPECT_EQ(database.at("/vrpn_mocap/QBii/pose").size(), 1466U);
  EXPECT_EQ(database.at("/odom").size(), 561U);
  EXPECT_EQ(database.at("/tf").size(), 561U);
}

TEST_F(BagSamples, McapBagsOfTheRecorderRead) {
  EXPECT_EQ(whole("mcap/cdr_test").messages.size(), 7U);
  EXPECT_EQ(whole("mcap/talker").messages.size(), 20U);
}

}  // namespace
}  // namespace astro::bag
