#include "host/commands/shared/unused_choices.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "host/console/wrong_usage.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::commands {
namespace {

using testing::StartsWith;

class UnusedChoices : public testing::Test {
 protected:
  UnusedChoices() {
    save("w.csv", "time_s,left_counts,right_counts\n");
    save("t.csv", "time_s,x_m,y_m\n");
    save("drive.mcap", "\x89MCAP0\r\n");
    save("robot.toml", "[parameters]\n");
    save("base.yaml", "controller:\n");
  }
  void save(const char* name, const char* text) const { std::ofstream(folder_.path() / name) << text; }

  /// A drive in these files.
  ImportOptions drive(const char* wheels, const char* truth) const {
    ImportOptions options;
    add(options, wheels, truth);
    return options;
  }
  void add(ImportOptions& options, const char* wheels, const char* truth) const {
    options.wheels.push_back(folder_.path() / wheels);
    options.truth.push_back(folder_.path() / truth);
  }
  static std::string refused(const ImportOptions& options) {
    try {
      refuse_unused_choices(options);
    } catch (const console::WrongUsage& wrong) {
      return wrong.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

TEST_F(UnusedChoices, AboutOtherKindsOfFilesAreRefusedByName) {
  const ImportOptions text = drive("w.csv", "t.csv"), bag = drive("drive.mcap", "drive.mcap");
  ImportOptions given = bag;
  given.table.columns = "time_s,left_counts,right_counts";
  const std::string no_table = " does not apply here: none of the files of wheels is a table",
                    no_joints =
                        " does not apply here: none of the files of wheels is a bag of another program",
                    no_poses = " does not apply here: none of the files of ground truth is a bag";
  EXPECT_EQ(refused(given), "--wheel-columns" + no_table);
  given = bag;
  given.table.per_interval = true;
  EXPECT_EQ(refused(given), "--per-interval" + no_table);
  given = bag;
  given.table.counter_range = 9'000;
  EXPECT_EQ(refused(given), "") << "counters of bags start again, too";
  given = bag;
  given.body = "ASTRO";
  EXPECT_EQ(refused(given), "--body does not apply here: all files of ground truth are bags");
  given = text;
  given.joints = {"l", "r"};
  EXPECT_EQ(refused(given), "--joints" + no_joints);
  given = text;
  given.wheels_topic = "/joint_states";
  EXPECT_EQ(refused(given), "--wheels-topic" + no_joints);
  given = text;
  given.wheels_unit = "rad";
  EXPECT_EQ(refused(given), "--wheels-unit" + no_joints);
  given = text;
  given.truth_topic = "/mocap";
  EXPECT_EQ(refused(given), "--truth-topic" + no_poses);
  given = text;
  given.frames = {"map", "base"};
  EXPECT_EQ(refused(given), "--truth-frames" + no_poses);
}

TEST_F(UnusedChoices, AreThoseThatApplyToNoneOfSeveralDrives) {
  ImportOptions mixed = drive("w.csv", "t.csv");
  mixed.truth_topic = "/mocap";
  EXPECT_THAT(refused(mixed), StartsWith("--truth-topic does not apply here"));
  add(mixed, "w.csv", "drive.mcap");
  mixed.table.per_interval = true;
  mixed.body = "ASTRO";
  EXPECT_EQ(refused(mixed), "");
  mixed.joints = {"l", "r"};
  EXPECT_THAT(refused(mixed), StartsWith("--joints does not apply here")) << "the bag has only the truth";
}

TEST_F(UnusedChoices, AControllerNeedsItsParameters) {
  ImportOptions options = drive("w.csv", "t.csv");
  options.controller = "base_controller";
  EXPECT_EQ(refused(options),
            "--controller does not apply here: no parameters of controllers (YAML) are named with --robot");
  options.robot_file = folder_.path() / "robot.toml";
  EXPECT_THAT(refused(options), StartsWith("--controller does not apply here"));
  options.robot_file = folder_.path() / "base.yaml";
  EXPECT_EQ(refused(options), "");
}

TEST_F(UnusedChoices, AboutFilesThatAreMissingAreLeftToTheirReaders) {
  ImportOptions options = drive("absent.csv", "absent.mcap");
  options.table.per_interval = true;
  options.joints = {"l", "r"};
  options.truth_topic = "/mocap";
  options.body = "ASTRO";
  EXPECT_EQ(refused(options), "");
}

TEST_F(UnusedChoices, AboutDrivesNeedDrives) {
  ImportOptions options;
  EXPECT_NO_THROW(refuse_choices_without_drives(options));
  options.up = "y";
  EXPECT_THROW(refuse_choices_without_drives(options), console::WrongUsage);
}

}  // namespace
}  // namespace astro::commands
