#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>

#include "tests/support/base/columns.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// Maximum likelihood from the command line: what is printed, refused, exported and uploaded.
namespace astro {
namespace {

namespace fs = std::filesystem;
using support::astrolabe;
using support::Outcome;
using support::Simulator;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kTrueEd = 1.00416, kTrueWheelbase_m = 0.28861;

std::string read(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// One small experiment that all tests use: 2 + 2 squares before, 1 + 1 after.
class Ml : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    simulator_ = new Simulator({"--fast", "--true-ed", std::to_string(kTrueEd), "--true-wheelbase",
                                std::to_string(kTrueWheelbase_m), "--slip", "2.645e-6", "--seed", "1"});
    // The fewest possible squares reach a precision of a tenth, so exactly these are driven.
    driven_ = astrolabe({"umbmark", "--port", simulator_->port(), "--truth", "sim", "--out", out(), "--side",
                         "1", "--runs", "1", "--until", "10%", "--no-extras", "--yes", "--json"});
  }
  static void TearDownTestSuite() {
    delete simulator_;
    simulator_ = nullptr;
  }
  void SetUp() override { ASSERT_EQ(driven_.code, 0) << driven_.err; }

  static std::string out() { return (simulator_->folder() / "x").string(); }
  static Outcome runs(std::vector<std::string> more, const std::string& folder = "/before") {
    std::vector<std::string> arguments{"calibrate", "runs", out() + folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return astrolabe(arguments);
  }
  static nlohmann::json json_of(std::vector<std::string> more, const std::string& folder = "/before") {
    more.push_back("--json");
    const Outcome outcome = runs(more, folder);
    EXPECT_THAT(outcome.code, folder.empty() ? AnyOf(0, kNotBetter) : AnyOf(0, 0)) << outcome.err;
    return support::parse_json(outcome.out);
  }

  /// What the robot carries after the experiment is what the same drives gave. With virtual time both phases may begin in
  /// the same second, and then nothing tells which of them was the last.
  static constexpr int kNotBetter = 3;

  inline static Simulator* simulator_ = nullptr;
  inline static Outcome driven_;
};

TEST_F(Ml, DrivesTheFewestSquaresWhereTheyAreEnough) {
  const nlohmann::json json = support::parse_json(driven_.out);
  EXPECT_EQ(json["before"]["cw"]["runs"], 2);
  EXPECT_EQ(json["after"]["cw"]["runs"], 1);
  EXPECT_EQ(json["phases"][0]["estimate"]["method"], "ml");
  EXPECT_THAT(driven_.err, HasSubstr("before: 2 + 2 squares give E_d ± "));
}

TEST_F(Ml, IsTheDefaultAndTellsAllThatItFound) {
  const nlohmann::json json = json_of({});
  EXPECT_EQ(json["method"], "ml");
  // Four standard errors, with a fixed seed.
  EXPECT_NEAR(json["E_d"].get<double>(), kTrueEd, 4 * json["standard_errors"]["E_d"].get<double>());
  EXPECT_NEAR(json["b_m"].get<double>(), kTrueWheelbase_m, 4 * json["standard_errors"]["b_m"].get<double>());
  EXPECT_NEAR(json["covariance"]["matrix"][2][2].get<double>(),
              std::pow(json["standard_errors"]["b_m"].get<double>(), 2), 1e-15);
  EXPECT_EQ(json["clock_known"], true);
  EXPECT_EQ(json["noise"]["given"], false);
  ASSERT_EQ(json["runs"].size(), 4U);
  EXPECT_EQ(json["runs"][0]["name"], "square-ccw-1");
  for (const char* key : {"distance_m", "rotation_rad", "chi_square", "degrees_of_freedom", "disagreement"})
    EXPECT_TRUE(json["runs"][0][key].is_number()) << key;
  EXPECT_NEAR(json["runs"][0]["distance_m"].get<double>(), 4, 0.05);
  EXPECT_GE(json["motions"].size(), 3U);
  EXPECT_TRUE(json["remarks"].is_array());
  EXPECT_TRUE(json["sessions"][0]["lever_arm"]["yaw_rad"].is_number());
}

TEST_F(Ml, IsReadableOnEightyColumns) {
  const Outcome outcome = runs({"--clock", "estimated"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* word : {"c_R", "c_L", "b mm", "E_d", "E_b", "tracked body", "ppm", "offset ms",
                           "square-cw-2", "disagrees", "rest", "line", "spin", "agree"})
    EXPECT_THAT(outcome.out, HasSubstr(word));
  EXPECT_LE(support::widest_line(outcome.out), 80U) << outcome.out;
}

TEST_F(Ml, TakesRunsOfSeveralPhasesTogether) {
  const nlohmann::json before = json_of({}), both = json_of({}, "");
  EXPECT_EQ(both["runs"].size(), 6U);
  EXPECT_EQ(both["runs"][0]["name"], "after/square-ccw-1");
  EXPECT_LT(both["standard_errors"]["E_d"].get<double>(), before["standard_errors"]["E_d"].get<double>());
  const Outcome umbmark = runs({"--method", "umbmark"}, "");
  EXPECT_EQ(umbmark.code, 1);
  EXPECT_THAT(umbmark.err, HasSubstr("different c_R, c_L or b"));
}

TEST_F(Ml, TakesEachPhaseForASessionIfAFolderIsOne) {
  const nlohmann::json found = json_of({}, ""), named = json_of({"--session-per-folder"}, "");
  EXPECT_EQ(found["sessions"].size(), 1U);
  ASSERT_EQ(named["sessions"].size(), 2U);
  EXPECT_EQ(named["sessions"][0]["name"], "after");
  EXPECT_EQ(named["sessions"][1]["name"], "before");
  const Outcome umbmark = runs({"--method", "umbmark", "--session-per-folder"});
  EXPECT_EQ(umbmark.code, 1);
  EXPECT_THAT(umbmark.err, HasSubstr("--session-per-folder is of maximum likelihood"));
}

TEST_F(Ml, LeavesOutWhatIsNamed) {
  const nlohmann::json json = json_of({"--without", "square-cw-1", "--without", "square-ccw-1"});
  EXPECT_EQ(json["runs"].size(), 2U);
  const Outcome outcome = runs({"--without", "square-cw-7"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("'square-cw-7'"), HasSubstr("square-cw-2")));
}

TEST_F(Ml, IsCheckedOnDrivesThatItHasNotSeen) {
  const std::string file = (simulator_->folder() / "checked.toml").string();
  ASSERT_EQ(runs({"--out", file}).code, 0);
  const Outcome json = astrolabe({"calibrate", "check", out() + "/before", "--with", file, "--json"});
  ASSERT_EQ(json.code, 0) << json.err;
  const nlohmann::json judged = nlohmann::json::parse(json.out);
  ASSERT_EQ(judged.size(), 2U);
  EXPECT_EQ(judged[0]["by"], "carried");
  EXPECT_EQ(judged[1]["by"], file);
  // The end error of 1 m squares is a seventh of that of 3 m squares; slip leaves a third of it.
  EXPECT_LT(judged[1]["end_m"].get<double>(), judged[0]["end_m"].get<double>() / 2);
  EXPECT_EQ(judged[1]["runs"][0]["name"], "square-ccw-1");

  const Outcome text =
      astrolabe({"calibrate", "check", out() + "/after", "--with", file, "--runs", "--session-per-folder"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("over 2 drives"), HasSubstr("heading mrad"), HasSubstr("square-cw-1")));
  // Other factors were loaded before than after.
  const Outcome both = astrolabe({"calibrate", "check", out(), "--with", file});
  EXPECT_EQ(both.code, 1);
  EXPECT_THAT(both.err, AllOf(HasSubstr("had other factors loaded"), HasSubstr("separately")));
  const Outcome missing = astrolabe({"calibrate", "check", out() + "/after", "--with", file + "x"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.err, HasSubstr("checked.tomlx does not exist"));
}

TEST_F(Ml, TakesTheNoiseThatIsGivenWholeOrNotAtAll) {
  const nlohmann::json json =
      json_of({"--K", "1e-6", "--sigma-xy", "0.0003", "--sigma-theta", "0.1", "--clock", "known"});
  EXPECT_EQ(json["noise"]["given"], true);
  EXPECT_EQ(json["noise"]["K_m"], 1e-6);
  EXPECT_EQ(json["noise"]["sigma_xy_m"], 0.0003);
  EXPECT_NEAR(json["noise"]["sigma_theta_rad"].get<double>(), 0.1 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(runs({"--K", "1e-6"}).code, 2);
  EXPECT_EQ(runs({"--K", "-1", "--sigma-xy", "0.0003", "--sigma-theta", "0.002"}).code, 2);
  const Outcome umbmark = runs({"--method", "umbmark", "--clock", "known"});
  EXPECT_EQ(umbmark.code, 1);
  EXPECT_THAT(umbmark.err, HasSubstr("--clock are of maximum likelihood"));
}

TEST_F(Ml, IsUploadedWhateverTheRobotCarriesButNotForAnotherWheel) {
  const std::string file = (simulator_->folder() / "calib.toml").string(), port = simulator_->port(),
                    kept = (simulator_->folder() / "kept.toml").string();
  ASSERT_EQ(runs({"--out", file}).code, 0);
  ASSERT_EQ(astrolabe({"params", "export", kept, "--port", port}).code, 0);
  EXPECT_EQ(astrolabe({"params", "set", "c_R=1.001", "--port", port}).code, 0);
  const Outcome outcome = astrolabe({"upload", file, "--port", port, "--yes"});
  EXPECT_EQ(outcome.code, 0) << outcome.err << "the factors are absolute";

  for (const char* assignment : {"wheel_diameter=0.08", "c_R=1"})
    EXPECT_EQ(astrolabe({"params", "set", assignment, "--port", port}).code, 0);
  const Outcome refused = astrolabe({"upload", file, "--port", port, "--yes"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("0.072 m"), HasSubstr("0.08 m"), HasSubstr("--force")));
  EXPECT_EQ(astrolabe({"params", "import", kept, "--port", port, "--yes"}).code, 0) << "for the other tests";
}

TEST_F(Ml, DamagedRecordingsAreUsedOnlyIfThatIsWantedAndThenWarnedOf) {
  namespace fs = std::filesystem;
  const fs::path copy = simulator_->folder() / "damaged", run = copy / "before" / "square-cw-1.mcap";
  fs::copy(out(), copy, fs::copy_options::recursive);
  std::fstream file(run, std::ios::in | std::ios::out | std::ios::binary);
  // A byte of the checksum before the end: no sample of the drive is missing, but the file is damaged anyway.
  const auto checksum = static_cast<std::streamoff>(fs::file_size(run) - 10);
  file.seekg(checksum);
  const char byte = static_cast<char>(file.get() ^ 1);
  file.seekp(checksum);
  file.put(byte);
  file.close();
  const std::string page = (copy / "page.html").string();
  for (std::vector<std::string> command :
       {std::vector<std::string>{"compare", copy.string()},
        {"report", copy.string(), "--out", page},
        {"calibrate", "runs", (copy / "before").string()},
        {"calibrate", "check", (copy / "before").string(), "--with", out() + "/calib-before.toml"}}) {
    const Outcome refused = astrolabe(command);
    EXPECT_EQ(refused.code, 1) << command[0];
    EXPECT_THAT(refused.err, AllOf(HasSubstr("square-cw-1.mcap is damaged"), HasSubstr("--damaged")));
    command.push_back("--damaged");
    const Outcome used = astrolabe(command);
    EXPECT_EQ(used.code, 0) << command[0] << ": " << used.err;
    EXPECT_THAT(used.err, AllOf(HasSubstr("warning: "), HasSubstr("square-cw-1.mcap is damaged")));
  }

  fs::copy_file(fs::path(out()) / "before" / "square-cw-1.mcap", run, fs::copy_options::overwrite_existing);
  fs::resize_file(run, fs::file_size(run) - 8);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"compare", copy.string()}, {"report", copy.string(), "--out", page}}) {
    const Outcome outcome = astrolabe(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("warning: "), HasSubstr("square-cw-1.mcap was cut off")));
  }
}

TEST_F(Ml, IsNotLoadedIntoAnotherRobotUnlessForcedAndWarnsOfItElsewhere) {
  const Simulator other({"--fast", "--seed", "2"});
  const std::string file = out() + "/calib-before.toml", drives = (other.folder() / "drives").string();
  const Outcome refused = astrolabe({"upload", file, "--port", other.port(), "--yes"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("the calibration is of robot "), HasSubstr("--force")));
  const Outcome forced = astrolabe({"upload", file, "--port", other.port(), "--yes", "--force"});
  EXPECT_EQ(forced.code, 0);
  EXPECT_THAT(forced.err, HasSubstr("warning: the calibration is of robot "));
  ASSERT_EQ(astrolabe({"record", "--squares", "2", "--side", "1", "--truth", "sim", "--port", other.port(),
                       "--out", drives})
                .code,
            0);
  EXPECT_THAT(astrolabe({"calibrate", "check", drives, "--with", file}).err,
              HasSubstr("warning: '" + file + "' is of robot "));
  EXPECT_THAT(astrolabe({"compare", out() + "/before", drives}).err,
              HasSubstr("warning: 'before' is of robot "));

  const Outcome same = astrolabe({"compare", out() + "/before", out() + "/after"});
  EXPECT_EQ(same.err, "");
  EXPECT_EQ(astrolabe({"calibrate", "check", out() + "/after", "--with", file}).err, "");
}

TEST_F(Ml, OfEndPosesStillNeedsWhatWasCarried) {
  const std::string file = (simulator_->folder() / "umbmark.toml").string();
  ASSERT_THAT(runs({"--method", "umbmark", "--out", file}).code, AnyOf(0, kNotBetter));
  const Outcome refused = astrolabe({"upload", file, "--port", simulator_->port(), "--yes"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("driven with")) << "the robot carries the calibration by now";
}

TEST_F(Ml, IsExportedByTheEndOfTheFile) {
  const fs::path folder = simulator_->folder();
  const std::string calib = out() + "/calib-before.toml";
  const auto exported = [&](const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"calibrate", "export", calib, "--to", (folder / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return astrolabe(arguments);
  };
  EXPECT_EQ(exported("a.yaml", {"--node", "base_controller"}).code, 0);
  EXPECT_THAT(read(folder / "a.yaml"),
              AllOf(HasSubstr("base_controller:\n  ros__parameters:\n    wheel_radius: 0.036\n"),
                    HasSubstr("wheel_separation_multiplier: 0.99")));
  EXPECT_EQ(exported("a.json").code, 0);
  EXPECT_EQ(support::parse_json(read(folder / "a.json"))["calibration"]["method"], "ml");
  EXPECT_EQ(exported("a.toml").code, 0);
  EXPECT_THAT(read(folder / "a.toml"), HasSubstr("[diff_drive_controller]"));
  EXPECT_EQ(exported("a.txt", {"--format", "json"}).code, 0);
  const Outcome refused = exported("b.txt");
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("b.txt"), HasSubstr("--format")));
  EXPECT_FALSE(fs::exists(folder / "b.txt"));
}

}  // namespace
}  // namespace astro
