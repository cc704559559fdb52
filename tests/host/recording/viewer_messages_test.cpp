#include <gmock/gmock.h>

#include "host/formats/files/bag.hpp"
#include "host/import/bags/bag_wheels.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/tum_export.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/temporary_folder.hpp"

// What our recordings carry for viewers, beside what they need themselves.
namespace astro::recording {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

Run driven(bool with_sizes) {
  Run run;
  run.info.started_at = "2024-06-11T12:00:00Z";
  if (with_sizes)
    run.info.parameters = {{"wheel_diameter", 0.1},
                           {"b", 0.3},
                           {"counts_per_motor_rev", 100},
                           {"gear_numerator", 20},
                           {"gear_denominator", 2}};
  for (int i = 0; i < 50; ++i) {
    run.odometry.push_back({20'000 * i, 0.01 * i, 0, 0.05 * i, 0.5, 2.5, 30 * i, -10 * i});
    run.truth.push_back({20'000 * i + 5'000, 0.01 * i, 0.5, i == 9 ? std::nan("") : 0.05 * i, i != 7});
  }
  return run;
}

class Viewer : public testing::Test {
 protected:
  std::vector<std::string> topics_of(const recording::Run& run) const {
    write_run(file_, run);
    std::vector<std::string> names;
    for (const bag::BagTopic& topic : bag::read_bag(file_).topics)
      names.push_back(topic.name + " " + std::to_string(topic.messages));
    return names;
  }
  test::TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "drive.mcap";
};

TEST_F(Viewer, FindsTheRobotItsBaseAndItsWheelsInARecording) {
  const auto topics = topics_of(driven(true));
  EXPECT_THAT(topics, Contains("/tf 50"));
  EXPECT_THAT(topics, Contains("/joint_states 50"));
  EXPECT_THAT(topics, Contains("/robot_description 1"));
  const importing::WheelTrack wheels = importing::wheels_in_bag(file_);
  EXPECT_NEAR(wheels.samples.back().left, 30 * 49 * 2 * M_PI / 1000, 1e-12);
}

TEST_F(Viewer, IsShownTheRobotAtMostFiftyTimesASecond) {
  recording::Run run = driven(true);
  run.odometry.clear();
  for (int i = 0; i < 1000; ++i)  // a second at the rate of the robot's control
    run.odometry.push_back({1'000 * i, 0.001 * i, 0, 0, 1, 0, i, i});
  const auto topics = topics_of(run);
  EXPECT_THAT(topics, Contains("/odom 1000"));
  EXPECT_THAT(topics, Contains("/tf 50"));
  EXPECT_THAT(topics, Contains("/joint_states 50"));
}

TEST_F(Viewer, KnowsTheRobotBeforeItMoves) {
  topics_of(driven(true));
  std::string first;
  bag::BagHandlers handlers;
  handlers.message = [&](const bag::BagTopic& topic, const bag::BagMessage&) {
    if (first.empty()) first = topic.name;
  };
  bag::read_bag(file_, handlers);
  EXPECT_EQ(first, "/robot_description");
}

TEST_F(Viewer, FindsTheBaseAloneInARecordingThatDoesNotKnowTheSizes) {
  const auto topics = topics_of(driven(false));
  EXPECT_THAT(topics, Contains("/tf 50"));
  EXPECT_THAT(topics, Not(Contains(HasSubstr("/joint_states"))));
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

TEST_F(Viewer, OfTumFilesFindsEachValidPose) {
  export_tum(driven(true), folder_.path() / "tum");
  const auto odometry = lines_of(folder_.path() / "tum/odometry.tum");
  ASSERT_EQ(odometry.size(), 51u);
  EXPECT_EQ(odometry[1], "0.000000 0 0 0 0 0 0 1");
  EXPECT_THAT(odometry[3], testing::StartsWith("0.040000 0.02 0 0 0 0 0.0499791"));
  const auto truth = lines_of(folder_.path() / "tum/truth.tum");
  EXPECT_EQ(truth.size(), 50u) << "without two poses, and with the comment that counts one of them";
  EXPECT_THAT(truth, Not(Contains(testing::StartsWith("0.185000"))))
      << "a heading that was not measured is not 0";
  EXPECT_EQ(truth.back(), "# left out because their heading was not measured: 1");
}

}  // namespace
}  // namespace astro::recording
