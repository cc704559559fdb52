#include "host/commands/shared/unused_choices.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "host/console/wrong_usage.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::commands {
namespace {

using testing::HasSubstr;

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
  EXPECT_THAT(refused(given), HasSubstr("--wheel-columns does not apply here: none of the files of wheels"));
  given = bag;
  given.table.per_interval = true;
  EXPECT_THAT(refused(given), HasSubstr("--per-interval"));
  given = bag;
  given.body = "ASTRO";
  EXPECT_THAT(refused(given), HasSubstr("--body"));
  given = text;
  given.joints = {"l", "r"};
  EXPECT_THAT(refused(given), HasSubstr("--joints"));
  given = text;
  given.wheels_topic = "/joint_states";
  EXPECT_THAT(refused(given), HasSubstr("--wheels-topic"));
  given = text;
  given.truth_topic = "/mocap";
  EXPECT_THAT(refused(given), HasSubstr("--truth-topic"));
  given = text;
  given.frames = {"map", "base"};
  EXPECT_THAT(refused(given), HasSubstr("--truth-frames"));
}

TEST_F(UnusedChoices, AreThoseThatApplyToNoneOfSeveralDrives) {
  ImportOptions mixed = drive("w.csv", "t.csv");
  mixed.truth_topic = "/mocap";
  EXPECT_THAT(refused(mixed), HasSubstr("--truth-topic"));
  add(mixed, "w.csv", "drive.mcap");
  mixed.table.per_interval = true;
  mixed.body = "ASTRO";
  EXPECT_EQ(refused(mixed), "");
  mixed.joints = {"l", "r"};
  EXPECT_THAT(refused(mixed), HasSubstr("--joints")) << "the bag has only the truth";
}

TEST_F(UnusedChoices, AControllerNeedsItsParameters) {
  ImportOptions options = drive("w.csv", "t.csv");
  options.controller = "base_controller";
  EXPECT_THAT(refused(options), HasSubstr("--controller"));
  options.robot_file = folder_.path() / "robot.toml";
  EXPECT_THAT(refused(options), HasSubstr("--controller"));
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
