#include "host/recording/rosbag_export.hpp"

#include <gmock/gmock.h>

#include "host/formats/files/bag.hpp"
#include "host/formats/files/yaml_scalars.hpp"
#include "host/formats/messages/text_message.hpp"
#include "host/import/bags/bag_wheels.hpp"
#include "host/import/bags/pose_topics.hpp"
#include "host/recording/robot_messages.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::recording {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

Run driven() {
  Run run;
  run.info.started_at = "2024-06-11T12:00:00Z";
  // 1000 counts are a turn of the wheel.
  run.info.parameters = {{"wheel_diameter", 0.1},
                         {"b", 0.3},
                         {"counts_per_motor_rev", 100},
                         {"gear_numerator", 20},
                         {"gear_denominator", 2}};
  for (int i = 0; i < 50; ++i) {
    run.odometry.push_back({20'000 * i, 0.01 * i, 0.02 * i, 0.05 * i, 0.5, 2.5,
                            static_cast<std::int32_t>(0x7FFF'FF00U + 30U * static_cast<unsigned>(i)),
                            -10 * i});
    run.truth.push_back({20'000 * i + 5'000, 0.01 * i, 0, 0.05 * i, i != 7});
  }
  return run;
}

struct Exported {
  test::TemporaryFolder folder;
  fs::path bag = folder.path() / "run 1";
  Exported() { export_rosbag(driven(), bag); }
};

TEST(RosbagExport, HasTheScansOfARunThatHasAny) {
  recording::Run run = driven();
  run.scans = {{200'000'000, 0, -0.02F, 0.0005F, 0.125, 12, {1, 2, 3}},
               {400'000'000, 0, -0.02F, 0.0005F, 0.125, 12, {4}}};
  const test::TemporaryFolder folder;
  export_rosbag(run, folder.path() / "scanned");
  const bag::made_bags::Seen seen = bag::made_bags::read(folder.path() / "scanned");
  const auto scans = std::ranges::find(seen.report.topics, "/scan", &bag::BagTopic::name);
  ASSERT_NE(scans, seen.report.topics.end());
  EXPECT_EQ(scans->type, "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(scans->messages, 2U);
  EXPECT_EQ(scans->last_ns - scans->first_ns, 200'000'000);
}

TEST(RosbagExport, HasWhatTheGyroSaidOfARobotThatUsesOne) {
  recording::Run run = driven();
  for (std::size_t i = 0; i < run.odometry.size(); i += 2)
    run.gyro.push_back({run.odometry[i].time_us, 1, 2, 0.5, 0.1});
  run.slips = {{150'000, 0.2}};
  const test::TemporaryFolder folder;
  export_rosbag(run, folder.path() / "with gyro");
  const bag::made_bags::Seen seen = bag::made_bags::read(folder.path() / "with gyro");
  const auto messages = [&](const char* topic, const char* type) {
    const auto found = std::ranges::find(seen.report.topics, topic, &bag::BagTopic::name);
    return found != seen.report.topics.end() && found->type == type ? found->messages : 0;
  };
  EXPECT_EQ(messages("/odom_gyro", "nav_msgs/msg/Odometry"), (run.odometry.size() + 1) / 2);
  EXPECT_EQ(messages("/gyro_slip", "astrolabe_msgs/msg/GyroSlip"), 1U);
}

TEST(RosbagExport, TopicsTimesAndMetadataAgree) {
  const Exported exported;
  const bag::made_bags::Seen seen = bag::made_bags::read(exported.bag);
  EXPECT_TRUE(seen.report.warnings.empty());
  EXPECT_EQ(seen.report.files.front(), exported.bag / "run 1_0.db3");
  std::map<std::string, std::uint64_t> counts;
  for (const bag::BagTopic& topic : seen.report.topics) counts[topic.name] = topic.messages;
  EXPECT_EQ(counts, (std::map<std::string, std::uint64_t>{{"/joint_states", 50},
                                                          {"/odom", 50},
                                                          {"/robot_description", 1},
                                                          {"/tf", 50},
                                                          {"/truth", 50},
                                                          {"/wheel_counts", 50}}));
  const Bytes yaml = load_file(exported.bag / "metadata.yaml");
  std::map<std::string, std::string> values;
  for (const bag::YamlScalar& scalar : bag::yaml_scalars(as_text(yaml), "metadata.yaml"))
    values[scalar.path] = scalar.value;
  const std::string root = "rosbag2_bagfile_information/";
  EXPECT_EQ(values[root + "message_count"], "251");
  EXPECT_EQ(values[root + "storage_identifier"], "sqlite3");
  EXPECT_EQ(values[root + "starting_time/nanoseconds_since_epoch"], "1718107200000000000");
  EXPECT_EQ(values[root + "duration/nanoseconds"], "985000000");
  EXPECT_EQ(values[root + "relative_file_paths/0"], "run 1_0.db3");
  EXPECT_THAT(values[root + "topics_with_message_count/5/topic_metadata/offered_qos_profiles"],
              HasSubstr("\n  durability: 1\n"));
}

TEST(RosbagExport, WheelsAndTruthComeBackThroughTheImporters) {
  const Exported exported;
  const importing::WheelTrack wheels = importing::wheels_in_bag(exported.bag);
  ASSERT_EQ(wheels.samples.size(), 50U);
  const double turn = 2 * std::numbers::pi;
  EXPECT_EQ(wheels.samples[49].time_ns, 980'000'000);
  EXPECT_NEAR(wheels.samples[49].left, 30 * 49 * turn / 1000, 1e-12) << "over the end of 32 bits";
  EXPECT_NEAR(wheels.samples[49].right, -10 * 49 * turn / 1000, 1e-12);
  const importing::PoseTopic truth = importing::poses_in_bag(exported.bag);
  EXPECT_EQ(truth.stream.topic, "/truth");
  ASSERT_EQ(truth.poses.size(), 50U);
  EXPECT_TRUE(std::isnan(truth.poses[7].x_m));
  EXPECT_NEAR(2 * std::atan2(truth.poses[9].qz, truth.poses[9].qw), 0.45, 1e-12);
}

TEST(RosbagExport, TheDescriptionAndTheTransformsNameTheSameFrames) {
  const Exported exported;
  std::string description;
  bag::BagHandlers handlers;
  handlers.message = [&](const bag::BagTopic& topic, const bag::BagMessage& message) {
    if (topic.name == "/robot_description") description = ros2::decode_text(message.data).value_or("");
  };
  bag::read_bag(exported.bag, handlers);
  for (const importing::PoseStream& stream : importing::pose_streams(exported.bag)) {
    if (stream.topic != "/tf") continue;
    EXPECT_EQ(stream.poses, 50U);
    EXPECT_THAT(description, HasSubstr("<link name=\"" + stream.child_frame + "\">"));
  }
  EXPECT_EQ(importing::pose_streams(exported.bag).size(), 5U);  // base, two wheels, odometry, truth
  EXPECT_THAT(description, HasSubstr("<joint name=\"left_wheel_joint\" type=\"continuous\">"));
  EXPECT_THAT(description, HasSubstr("xyz=\"0 0.15 0.05\""));
}

TEST(RosbagExport, ARunWithoutSizesHasNoDescription) {
  recording::Run run = driven();
  run.info.parameters.clear();
  const test::TemporaryFolder folder;
  export_rosbag(run, folder.path());
  EXPECT_EQ(bag::read_bag(folder.path()).topics.size(), 4U);
}

TEST(RosbagExport, ABagNeverGoesIntoAFolderThatHoldsSomething) {
  const Exported exported;
  EXPECT_THAT([&] { export_rosbag(driven(), exported.bag); },
              astro::support::ThrowsTelling(bag::BagProblem::folder_not_empty, exported.bag.string()));
}

// The command sqlite3 shares no code with our SQL.
TEST(RosbagExport, TheCommandOfSqliteFindsTheDatabaseWhole) {
  if (std::system("sqlite3 --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no command sqlite3";
  const Exported exported;
  const std::string query =
      "sqlite3 '" + (exported.bag / "run 1_0.db3").string() +
      "' 'PRAGMA integrity_check' 'SELECT schema_version FROM schema' \"SELECT count(*), min(timestamp), "
      "max(length(data)) FROM messages m JOIN topics t ON t.id=m.topic_id WHERE t.name='/odom'\" "
      "'SELECT count(*) FROM message_definitions'";
  FILE* pipe = popen(query.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  char text[256] = {};
  const std::size_t size = std::fread(text, 1, sizeof text - 1, pipe);
  EXPECT_EQ(pclose(pipe), 0);
  EXPECT_EQ(std::string(text, size), "ok\n4\n50|1718107200000000000|724\n6\n");
}

}  // namespace
}  // namespace astro::recording
