#include "host/import/drives/bag_truth.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "host/formats/messages/stamped_pose.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::importing {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

truth::BodyTrack track_of(const std::vector<ros2::StampedPose>& poses) {
  const test::TemporaryFolder folder;
  Bytes file;
  bag::McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"});
  const auto channel =
      writer.add_channel(writer.add_schema(ros2::tf_message_type().name, "ros2msg", ""), "/tf", "cdr", {});
  for (const ros2::StampedPose& pose : poses)
    writer.write(channel, static_cast<std::uint64_t>(pose.time_ns), ros2::encode_tf({pose}));
  writer.close();
  bag::made_bags::save(folder.path() / "x.mcap", file);
  return track_in_bag(folder.path() / "x.mcap", {"/tf", "", ""});
}

TEST(BagTruth, PosesAreATrackOfTheChildFrameAndImpossibleOnesAreLost) {
  const truth::BodyTrack track = track_of({{1, "map", "robot", 1, 2, 3, 0, 0, 1.0001, 0},
                                           {2, "map", "robot", 0, 0, 0, 0, 0, 0, 0},
                                           {3, "map", "robot", kNan, 2, 3, 0, 0, 1, 0}});
  EXPECT_EQ(track.name, "robot");
  EXPECT_EQ(track.facts.format, "ROS 2 bag, /tf map robot of tf2_msgs/msg/TFMessage");
  EXPECT_EQ(track.facts.rotation_kind, truth::RotationKind::quaternion);
  ASSERT_EQ(track.samples.size(), 3U);
  EXPECT_TRUE(track.samples[0].valid);
  EXPECT_EQ(track.samples[0].pose.qz, 1);
  EXPECT_EQ(track.samples[0].pose.z_m, 3);
  EXPECT_FALSE(track.samples[1].valid);
  EXPECT_FALSE(track.samples[2].valid);
}

TEST(BagTruth, PosesWithoutAnyRotationArePositions) {
  const truth::BodyTrack track = track_of({{1, "map", "robot", 1, 2, 3, kNan, kNan, kNan, kNan},
                                           {2, "map", "robot", 0, 0, 0, 0, 0, 0, 0},
                                           {3, "map", "robot", 4, 5, 6, 0, 0, 0, 0},
                                           {4, "map", "robot", 0, 0, 0, kNan, kNan, kNan, kNan},
                                           {5, "map", "robot", kNan, 5, 6, 0, 0, 0, 0}});
  EXPECT_EQ(track.facts.rotation_kind, truth::RotationKind::none);
  std::vector<bool> valid;
  for (const truth::TrackedPose& sample : track.samples) valid.push_back(sample.valid);
  EXPECT_THAT(valid, testing::ElementsAre(true, false, true, true, false)) << "zeros and NaN are lost";
}

}  // namespace
}  // namespace astro::importing
