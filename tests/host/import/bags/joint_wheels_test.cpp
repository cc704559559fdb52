#include "host/import/bags/bag_wheels.hpp"

#include <gmock/gmock.h>

#include "host/formats/messages/joint_state.hpp"
#include "host/import/bags/stamp_count.hpp"
#include "host/import/wheels/diff_drive_yaml.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using ros2::JointState;
using support::Tells;
using support::ThrowsTelling;
using ::testing::ElementsAre;

std::optional<JointPair> recognised(const std::vector<std::string>& names) { return recognise_wheels(names); }

TEST(JointNames, TheWheelsOfUsualRobotsAreRecognised) {
  const auto is = [](const std::string& left, const std::string& right) { return JointPair{left, right}; };
  EXPECT_EQ(recognised({"wheel_left_joint", "wheel_right_joint"}),
            is("wheel_left_joint", "wheel_right_joint"));
  EXPECT_EQ(recognised({"r_wheel", "arm_1", "l_wheel"}), is("l_wheel", "r_wheel"));
  EXPECT_EQ(recognised({"leftWheel", "rightWheel"}), is("leftWheel", "rightWheel"));
  EXPECT_EQ(recognised({"base/leftmotor", "base/rightmotor"}), is("base/leftmotor", "base/rightmotor"));
  EXPECT_EQ(recognised({"left", "right"}), is("left", "right"));
  EXPECT_EQ(recognised({"mr_left_wheel", "mr_right_wheel"}), is("mr_left_wheel", "mr_right_wheel"));
  EXPECT_EQ(recognised({"rueda_izquierda", "rueda_derecha"}), is("rueda_izquierda", "rueda_derecha"));
  EXPECT_EQ(recognised({"left_gripper_joint", "right_gripper_joint", "drivewhl_l_joint", "drivewhl_r_joint"}),
            is("drivewhl_l_joint", "drivewhl_r_joint"));
}

TEST(JointNames, SeveralPairsOrNoneAreUnclear) {
  EXPECT_FALSE(recognised({"front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel"}));
  EXPECT_FALSE(recognised({"wheel_1", "wheel_2"}));
  EXPECT_FALSE(recognised({"left_wheel", "left-wheel", "right_wheel"}));
  EXPECT_FALSE(recognised({"left_wheel"}));
  EXPECT_FALSE(recognised({}));
}

class JointWheels : public ::testing::Test {
 protected:
  using Topics = std::vector<std::pair<std::string, std::vector<JointState>>>;

  fs::path bag(const Topics& topics) const {
    const fs::path path = folder_.path() / "x.mcap";
    Bytes file;
    bag::McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"});
    const auto schema = writer.add_schema(ros2::joint_state_type().name, "ros2msg", "");
    for (const auto& [topic, states] : topics) {
      const auto channel = writer.add_channel(schema, topic, "cdr", {});
      std::uint64_t log_time_ns = 100;
      for (const JointState& state : states)
        writer.write(channel, log_time_ns++, ros2::encode_joint_state(state));
    }
    writer.close();
    bag::made_bags::save(path, file);
    return path;
  }
  Remark refusal(const Topics& topics, const BagWheelSelection& selection) const {
    return support::told_by([&] { wheels_in_bag(bag(topics), selection); });
  }
  const test::TemporaryFolder folder_;
};

const std::vector<std::string> kNames{"right_wheel", "arm", "left_wheel"};

TEST_F(JointWheels, PositionsOfRecognisedJointsAreRead) {
  const WheelTrack track = wheels_in_bag(bag({{"/joint_states",
                                               {{10, kNames, {1, 9, 2}, {}, {}},
                                                {15, {"arm"}, {9}, {}, {}},  // another driver's message
                                                {20, kNames, {3, 9, 5}, {0, 0, 0}, {}}}}}));
  EXPECT_EQ(track.unit, WheelUnit::radians);
  EXPECT_EQ(track.clock, WheelClock::stamp);
  EXPECT_THAT(track.samples, ElementsAre(WheelSample{10, 2, 1}, WheelSample{20, 5, 3}));
  ASSERT_FALSE(track.remarks.empty());
  EXPECT_THAT(track.remarks[0], Tells(ChoiceRemark::joints_recognised, "left_wheel", "right_wheel"));
}

TEST_F(JointWheels, VelocitiesAreIntegratedWhereThereAreNoPositions) {
  const std::int64_t second = 1'000'000'000;
  const WheelTrack track = wheels_in_bag(bag({{"/joint_states",
                                               {{second, {"l", "r"}, {}, {1, -1}, {}},
                                                {2 * second, {"l", "r"}, {}, {3, -1}, {}},
                                                {4 * second, {"l", "r"}, {}, {3, 0}, {}}}}}));
  EXPECT_THAT(track.samples, ElementsAre(WheelSample{second, 0, 0}, WheelSample{2 * second, 2, -1},
                                         WheelSample{4 * second, 8, -2}));
}

TEST_F(JointWheels, PositionsThatStartAgainEachTurnAreMadeContinuous) {
  const double pi = std::numbers::pi;
  const WheelTrack track = wheels_in_bag(bag({{"/joint_states",
                                               {{1, {"l", "r"}, {0, 3}, {}, {}},
                                                {2, {"l", "r"}, {2, -3}, {}, {}},
                                                {3, {"l", "r"}, {-2, -1}, {}, {}}}}}));
  EXPECT_NEAR(track.samples[2].left, 2 * pi - 2, 1e-12);
  EXPECT_NEAR(track.samples[2].right, 2 * pi - 1, 1e-12);
}

TEST_F(JointWheels, MessagesWithoutStampsHaveTheTimesOfTheRecorder) {
  const WheelTrack track = wheels_in_bag(
      bag({{"/joint_states", {{0, {"l", "r"}, {0, 1}, {}, {}}, {0, {"l", "r"}, {1, 2}, {}, {}}}}}));
  EXPECT_EQ(track.clock, WheelClock::receipt);
  EXPECT_THAT(track.samples, ElementsAre(WheelSample{100, 0, 1}, WheelSample{101, 1, 2}));
}

TEST_F(JointWheels, StampsOfOtherDriversOnTheTopicDoNotCount) {
  const WheelTrack track = wheels_in_bag(bag({{"/joint_states",
                                               {{7, {"arm"}, {9}, {}, {}},
                                                {0, {"l", "r"}, {0, 1}, {}, {}},
                                                {8, {"arm"}, {9}, {}, {}},
                                                {0, {"l", "r"}, {1, 2}, {}, {}}}}}),
                                         {"", {"l", "r"}});
  EXPECT_EQ(track.clock, WheelClock::receipt);
  EXPECT_THAT(track.samples, ElementsAre(WheelSample{101, 0, 1}, WheelSample{103, 1, 2}));
}

TEST_F(JointWheels, MessagesBeforeTheFirstStampAreLeftOut) {
  constexpr std::int64_t late = 5'000'000'000;
  const WheelTrack track = wheels_in_bag(bag({{"/joint_states",
                                               {{0, {"l", "r"}, {0, 1}, {}, {}},
                                                {late, {"l", "r"}, {1, 2}, {}, {}},
                                                {late + 1, {"l", "r"}, {2, 3}, {}, {}}}}}));
  EXPECT_THAT(track.samples, ElementsAre(WheelSample{late, 1, 2}, WheelSample{late + 1, 2, 3}));
  EXPECT_THAT(track.remarks.back(), Tells(StampProblem::missing, "messages of /joint_states", "1"));
}

TEST_F(JointWheels, WhatIsUnclearIsRefusedWithTheChoices) {
  const std::vector<JointState> pair{{1, {"l", "r"}, {0, 1}, {}, {}}, {2, {"l", "r"}, {1, 2}, {}, {}}};
  const std::vector<JointState> four{{1, {"fl", "fr"}, {0, 1}, {}, {}}, {2, {"fl", "fr"}, {1, 2}, {}, {}}};
  EXPECT_THAT(refusal({{"/a", pair}, {"/b", pair}}, {}), Tells(WheelProblem::topic_unclear, "/a", "/b"));
  EXPECT_THAT(refusal({{"/a", pair}}, {"/b", {}}), Tells(WheelProblem::topic_unclear, "/a"));
  EXPECT_THAT(refusal({{"/a", four}}, {}), Tells(WheelProblem::joints_unclear, "fl", "fr"));
  EXPECT_THAT(refusal({{"/a", pair}}, {"/a", {"l", "x"}}), Tells(WheelProblem::joints_unclear, "l", "r"));
  EXPECT_THAT(refusal({{"/a", pair}}, {"/a", {"l", "l"}}), Tells(WheelProblem::joints_unclear, "l", "r"));
  EXPECT_THAT(refusal({}, {}), Tells(WheelProblem::nothing_to_choose));
  EXPECT_EQ(wheels_in_bag(bag({{"/a", four}, {"/b", pair}}), {"/a", {"fr", "fl"}}).samples[0],
            (WheelSample{1, 1, 0}));
}

constexpr std::string_view kYaml =
    "/robot:\n  base_controller:\n    ros__parameters:\n      type: x\n      left_wheel_names: [\"lw\"]\n"
    "      right_wheel_names:\n        - rw\n      wheel_radius: 0.033\n      wheel_separation: 0.16\n"
    "      left_wheel_radius_multiplier: 1.01\n      wheel_separation_multiplier: 0.99\n";

TEST(DiffDriveYaml, TheControllersParametersAreRead) {
  const DiffDriveParameters read = diff_drive_parameters(kYaml, "c.yaml");
  EXPECT_EQ(read.node, "/robot/base_controller");
  EXPECT_EQ(read.wheel_radius_m, 0.033);
  EXPECT_EQ(read.wheel_separation_m, 0.16);
  EXPECT_EQ(read.left_wheel_radius_multiplier, 1.01);
  EXPECT_EQ(read.right_wheel_radius_multiplier, 1);
  EXPECT_EQ(read.wheel_separation_multiplier, 0.99);
  EXPECT_THAT(read.left_wheel_names, ElementsAre("lw"));
  EXPECT_THAT(read.right_wheel_names, ElementsAre("rw"));
}

TEST(DiffDriveYaml, JointsThatTurnBackwardAndOpenLoopsAreRead) {
  const DiffDriveParameters read = diff_drive_parameters(
      std::string(kYaml) + "      right_wheel_radius_multiplier: -1.02\n      open_loop: true\n", "c.yaml");
  EXPECT_EQ(read.right_wheel_radius_multiplier, -1.02);
  EXPECT_TRUE(read.open_loop);
  EXPECT_THAT(
      [] { diff_drive_parameters("a:\n  wheel_radius: 1\n  left_wheel_radius_multiplier: 0\n", "c.yaml"); },
      ThrowsTelling(ControllerProblem::zero, "c.yaml", "3", "0"));
}

TEST(DiffDriveYaml, NestedParametersOfRos1AreRead) {
  const DiffDriveParameters read = diff_drive_parameters(
      "robot:\n  mobile_base:\n    controller:\n      type: diff_drive_controller/DiffDriveController\n"
      "      left_wheel: lw\n      right_wheel: [rw, rear_rw]\n      wheel_radius: 0.033\n"
      "      wheel_separation: 0.16\n      pose_covariance_diagonal: [0.1, 0.2]\n",
      "c.yaml");
  EXPECT_EQ(read.node, "robot/mobile_base/controller");
  EXPECT_EQ(read.wheel_radius_m, 0.033);
  EXPECT_EQ(read.wheel_separation_m, 0.16);
  EXPECT_THAT(read.left_wheel_names, ElementsAre("lw"));
  EXPECT_THAT(read.right_wheel_names, ElementsAre("rw", "rear_rw"));
}

TEST(DiffDriveYaml, SeveralControllersAndBadValuesAreRefused) {
  const std::string two =
      std::string(kYaml) + "other:\n  ros__parameters: {wheel_radius: 1, wheel_separation: 2}\n";
  EXPECT_THAT([&] { diff_drive_parameters(two, "c.yaml"); },
              ThrowsTelling(WheelProblem::controller_unclear, "/robot/base_controller", "other"));
  EXPECT_EQ(diff_drive_parameters(two, "c.yaml", "other").wheel_radius_m, 1);
  EXPECT_THAT([] { diff_drive_parameters("a: 1", "c.yaml"); },
              ThrowsTelling(WheelProblem::nothing_to_choose));
  EXPECT_THAT([] { diff_drive_parameters("a:\n  ros__parameters:\n    wheel_radius: -1\n", "c.yaml"); },
              ThrowsTelling(ControllerProblem::not_above_zero, "c.yaml", "3", "-1"));
}

}  // namespace
}  // namespace astro::importing
