#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/experiment/analysis/calibration.hpp"
#include "host/import/drives/import_drives.hpp"
#include "host/import/scans/carmen_log.hpp"
#include "host/lidar/scan_calibration.hpp"
#include "host/page/calls/calls.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/host/import/drives/drive_files.hpp"
#include "tests/host/import/scans/carmen_text.hpp"
#include "tests/support/base/places.hpp"
#include "tests/support/base/temporary_folder.hpp"

// What the page asks about files that somebody dropped on it.
namespace astro::page {
namespace {

namespace fs = std::filesystem;
using calibration::Trajectory;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

class DataCalls : public testing::Test {
 protected:
  /// Squares of a robot with known factors.
  static const std::vector<Trajectory>& drives() {
    static const std::vector<Trajectory> runs = [] {
      simulation::study::DriveModel model = calibration::astro_drive();
      model.metres_per_count = test::kMetresPerCount;
      model.clock_offset_s = 0.031;
      return calibration::squares(model, 3, 2);
    }();
    return runs;
  }
  fs::path at(const std::string& name) const { return folder_.path() / name; }

  json ask(const std::string& call, const json& question) const {
    return answer(call, question, folder_.path(), [](const json&) {});
  }
  json inspected(const json& question) const {
    const json told = ask("inspect", question);
    EXPECT_TRUE(told.contains("result")) << told;
    return told.value("result", json::object());
  }
  std::string sentence(const std::string& call, const json& question) const {
    return ask(call, question).at("error").at("sentence");
  }

  /// wheels1.csv and take1.csv, wheels2.csv ...
  void write_files() const {
    int number = 0;
    for (const Trajectory& drive : drives()) {
      ++number;
      test::write_counts(at(fmt::format("wheels{}.csv", number)), drive);
      test::write_motive(at(fmt::format("take{}.csv", number)), drive);
    }
  }
  static json sizes() {
    return {{"wheel_diameter", test::kDiameter_m},
            {"counts_per_turn", test::kCountsPerTurn},
            {"wheelbase", 0.29}};
  }
  static json with(json question, const json& more) {
    question.update(more);
    return question;
  }
  static json names() {
    return {"take1.csv", "take2.csv", "take3.csv", "wheels1.csv", "wheels2.csv", "wheels3.csv"};
  }

  test::TemporaryFolder folder_;
};

TEST_F(DataCalls, FilesAreRecognisedPairedAndCalibratedAsTheLibrariesDo) {
  write_files();
  const json found = inspected({{"files", names()}});
  for (const json& file : found["files"]) {
    const bool wheels = file["name"].get<std::string>().starts_with("wheels");
    EXPECT_EQ(file["wheels"], wheels) << file["name"];
    EXPECT_EQ(file["truth"], !wheels) << file["name"];
    EXPECT_EQ(file["problem"], nullptr) << file["problem"];
  }
  EXPECT_EQ(found["drives"].dump(),
            R"([{"truth":"take1.csv","wheels":"wheels1.csv"},{"truth":"take2.csv",)"
            R"("wheels":"wheels2.csv"},{"truth":"take3.csv","wheels":"wheels3.csv"}])");

  const json told = ask("calibrate", with(sizes(), {{"drives", found["drives"]}}));
  ASSERT_TRUE(told.contains("result")) << told;
  importing::ImportChoices choices;
  choices.geometry.wheel_diameter_m = test::kDiameter_m;
  choices.geometry.counts_per_turn = test::kCountsPerTurn;
  choices.geometry.wheelbase_m = 0.29;
  std::vector<importing::DriveFiles> files;
  for (int i = 1; i <= 3; ++i)
    files.push_back({at(fmt::format("wheels{}.csv", i)), at(fmt::format("take{}.csv", i))});
  const experiment::Calibration expected = experiment::calibrate(importing::import_drives(files, choices).set,
                                                                 {experiment::MethodChoice::Family::ml, {}});
  const json& calibration = told["result"]["calibration"];
  EXPECT_EQ(calibration["c_R"], expected.factors.c_r);
  EXPECT_EQ(calibration["c_L"], expected.factors.c_l);
  EXPECT_EQ(calibration["b_m"], expected.factors.b_m);
  for (const char* name : {"toml", "report", "ros2"})
    EXPECT_TRUE(fs::exists(at(told["result"][name].get<std::string>()))) << name;
  EXPECT_EQ(told["result"]["drives"].size(), 3U);
}

TEST_F(DataCalls, WhatIsUnderstoodIsThatOfTheStatedColumnsAndBody) {
  write_files();
  const json found = inspected({{"files", {"wheels1.csv", "take1.csv"}}});
  const json &wheels = found["files"][0]["understood"]["wheels"],
             &truth = found["files"][1]["understood"]["truth"];
  EXPECT_EQ(wheels["columns"]["time"], "time_s");
  EXPECT_EQ(wheels["columns"]["values"], "counts");
  EXPECT_EQ(wheels["clock"], "file");
  EXPECT_EQ(wheels["samples"], drives().front().wheels.size());
  EXPECT_NEAR(truth["up_by_positions"][1].get<double>(), 1, 1e-9) << "Motive's y is up";
  EXPECT_EQ(truth["lost"], 0);
  EXPECT_FALSE(found["files"][0]["understood"].contains("truth"));
  const json exchanged =
      inspected({{"files", {"wheels1.csv"}}, {"wheel_columns", "time_s,right_counts,left_counts"}});
  EXPECT_EQ(exchanged["files"][0]["understood"]["wheels"]["columns"]["left"], json{"right_counts"});
}

TEST_F(DataCalls, AFileThatIsNamedLikeAResultStaysAsItIs) {
  write_files();
  const std::string sizes_of_robot =
      "[parameters]\nwheel_diameter = 0.084\ncounts_per_motor_rev = 4096\nb = 0.29\n";
  std::ofstream(at("calib.toml")) << sizes_of_robot;
  const json drives = {{{"wheels", "wheels1.csv"}, {"truth", "take1.csv"}},
                       {{"wheels", "wheels2.csv"}, {"truth", "take2.csv"}}};
  EXPECT_EQ(inspected({{"files", {"calib.toml"}}})["files"][0]["robot"], true);
  json answers[] = {ask("calibrate", {{"drives", drives}, {"robot", "calib.toml"}}),
                    ask("calibrate", {{"drives", drives}, {"robot", "calib.toml"}})};
  ASSERT_TRUE(answers[0].contains("result")) << answers[0];
  EXPECT_EQ(answers[0], answers[1]);
  std::ifstream kept(at("calib.toml"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), sizes_of_robot);
}

TEST_F(DataCalls, APreviewHasBothEndsOfADriveAndFewPoints) {
  write_files();
  const json found = inspected({{"files", {"wheels1.csv", "take1.csv"}}});
  const Trajectory& drive = drives().front();
  const json& wheels = found["files"][0]["preview"]["wheels"];
  ASSERT_EQ(wheels["t_s"].size(), 600U);
  EXPECT_EQ(wheels["left"][0], 0);
  EXPECT_NEAR(wheels["t_s"].back().get<double>(), drive.wheels.back().time_s - drive.wheels.front().time_s,
              1e-6);
  // The counts are whole, so both ends are off by at most half of one.
  EXPECT_NEAR(wheels["right"].back().get<double>() * test::kMetresPerCount,
              drive.wheels.back().right_m - drive.wheels.front().right_m, test::kMetresPerCount);
  const json& truth = found["files"][1]["preview"]["truth"];
  EXPECT_LE(truth["t_s"].size(), 600U);
  EXPECT_NEAR(truth["y_m"][0].get<double>(), test::kHeight_m, 1e-6) << "Motive's y is up";
}

TEST_F(DataCalls, AColumnOfAnUnknownNameIsMendedByOneStatement) {
  const Trajectory& drive = drives().front();
  test::write_lines(at("log.csv"), "stamp_s,a,b,battery\n", drive.wheels, [](const auto& row) {
    return fmt::format("{:.9f},{},{},12.1", row.time_s, std::llround(row.left_m / test::kMetresPerCount),
                       std::llround(row.right_m / test::kMetresPerCount));
  });
  const json unclear = inspected({{"files", {"log.csv"}}})["files"][0];
  EXPECT_EQ(unclear["wheels"], true) << "recordings of trackers are known by their form";
  ASSERT_TRUE(unclear["problem"].is_object()) << unclear;
  EXPECT_THAT(unclear["problem"]["remedies"], ElementsAre("wheel_columns"));
  EXPECT_THAT(unclear["problem"]["sentence"].get<std::string>(), testing::StartsWith("log.csv:"))
      << "a person knows the file by this name alone";
  EXPECT_EQ(unclear["table"]["names"], (json{"stamp_s", "a", "b", "battery"}));
  const json mended =
      inspected({{"files", {"log.csv"}}, {"wheel_columns", "stamp_s,left_counts,right_counts,-"}});
  EXPECT_EQ(mended["files"][0]["problem"], nullptr);
  const json& columns = mended["files"][0]["understood"]["wheels"]["columns"];
  EXPECT_EQ(columns["left"], json{"a"});
  EXPECT_EQ(columns["right"], json{"b"});
}

TEST_F(DataCalls, EachRoleThatAColumnIsOfferedCanBeRead) {
  const Trajectory& drive = drives().front();
  test::write_lines(at("log.csv"), "", drive.wheels, [](const auto& row) {
    return fmt::format("{:.9f},{:.6f},{:.6f}", row.time_s, row.left_m, row.right_m);
  });
  const json roles = inspected({{"files", json::array()}})["roles"]["wheels"];
  int sides = 0;
  for (const json& each : roles) {
    const std::string role = each;
    if (!role.starts_with("left_")) continue;
    ++sides;
    const std::string columns = "time_s," + role + ",right_" + role.substr(5);
    const json file = inspected({{"files", {"log.csv"}}, {"wheel_columns", columns}})["files"][0];
    EXPECT_EQ(file["problem"], nullptr) << columns << file["problem"];
  }
  EXPECT_EQ(sides, 9) << roles;
}

TEST_F(DataCalls, ABagIsADriveOfItsOwn) {
  test::write_bag(at("bag"), drives().front());
  for (const auto& entry : fs::directory_iterator(at("bag")))
    if (entry.path().extension() == ".db3") fs::copy(entry.path(), at("drive.db3"));
  const json found = inspected({{"files", {"drive.db3"}}});
  EXPECT_EQ(found["drives"].dump(), R"([{"truth":"drive.db3","wheels":"drive.db3"}])");
  EXPECT_EQ(found["files"][0]["problem"], nullptr) << found["files"][0]["problem"];
  EXPECT_EQ(found["files"][0]["table"], nullptr);
  EXPECT_FALSE(found["files"][0]["preview"]["wheels"]["left"].empty());
  EXPECT_FALSE(found["files"][0]["preview"]["truth"]["x_m"].empty());
}

TEST_F(DataCalls, AmongSeveralControllersOneIsChosenAndOtherFilesHaveNoProblem) {
  write_files();
  std::ofstream(at("controllers.yaml"))
      << "left:\n  ros__parameters:\n    wheel_separation: 0.31\n    wheel_radius: 0.05\n"
         "right:\n  ros__parameters:\n    wheel_separation: 0.29\n    wheel_radius: 0.042\n";
  const json files = {{"files", {"controllers.yaml", "wheels1.csv"}}, {"robot", "controllers.yaml"}};
  const json unclear = inspected(files)["files"];
  EXPECT_EQ(unclear[0]["robot"], true);
  EXPECT_EQ(unclear[0]["controllers"], (json{"left", "right"}));
  EXPECT_THAT(unclear[0]["problem"]["remedies"], ElementsAre("controller"));
  EXPECT_EQ(unclear[1]["problem"], nullptr) << unclear[1]["problem"];
  const json chosen = inspected(with(files, {{"controller", "right"}}))["files"];
  EXPECT_EQ(chosen[0]["problem"], nullptr) << chosen[0]["problem"];
  EXPECT_EQ(chosen[0]["controllers"], (json{"left", "right"})) << "so that another one can be chosen";
  EXPECT_EQ(chosen[0]["inspection"]["wheelbase_m"], 0.29);
}

TEST_F(DataCalls, TheScansOfALaserScannerAreGroundTruth) {
  lidar::Scanner scanner;
  scanner.beams = 180;
  scanner.view_rad = std::numbers::pi;
  scanner.period_s = 0.4;
  lidar::SyntheticDrive drive(lidar::furnished_room(), {{1.013, 1.007, 0.306}, 2e-6}, scanner, 21);
  lidar::drive_both_ways(drive, 3);
  std::ofstream(at("room.log")) << importing::carmen_text(drive, false);
  const json found = inspected({{"files", {"room.log"}}});
  EXPECT_EQ(found["files"][0]["scans"], true);
  EXPECT_EQ(found["files"][0]["problem"], nullptr) << found["files"][0]["problem"];
  EXPECT_EQ(found["drives"].dump(), R"([{"truth":"room.log","wheels":"room.log"}])");
  EXPECT_THAT(ask("calibrate", {{"drives", found["drives"]}})["error"]["remedies"],
              ElementsAre("wheelbase", "robot"));
  const json stated = {{"drives", found["drives"]}, {"wheelbase", lidar::kNominalBase_m}};
  const json told = ask("calibrate", stated);
  ASSERT_TRUE(told.contains("result")) << told;
  const importing::CarmenLog log = importing::read_carmen_log(at("room.log"), lidar::kNominalBase_m);
  const lidar::ScanCalibration expected = lidar::calibrate_by_scans({&log.drive, 1}, lidar::kLoaded);
  EXPECT_EQ(told["result"]["calibration"]["b_m"], expected.factors.b_m);
  EXPECT_EQ(told["result"]["calibration"]["c_R"], expected.factors.c_r);
  EXPECT_EQ(told["result"]["advises_against"], false) << told["result"]["verdict"];
  for (const char* file : {"toml", "report"})
    EXPECT_TRUE(fs::exists(at(told["result"][file].get<std::string>()))) << file;
  EXPECT_THAT(ask("calibrate", with(stated, {{"up", "z"}}))["error"]["remedies"], ElementsAre("up"));

  write_files();
  const json mixed = {{{"wheels", "room.log"}, {"truth", "room.log"}},
                      {{"wheels", "wheels1.csv"}, {"truth", "take1.csv"}}};
  EXPECT_THAT(sentence("calibrate", with(sizes(), {{"drives", mixed}})), HasSubstr("leave one kind out"));
}

TEST_F(DataCalls, WhatIsMissingOrInTheWayIsNamedWithWhatHelps) {
  write_files();
  const json drives = {{{"wheels", "wheels1.csv"}, {"truth", "take1.csv"}}};
  const auto remedies = [&](const json& more) {
    const json told = ask("calibrate", with({{"drives", drives}}, more));
    EXPECT_TRUE(told.contains("error")) << told;
    return told.contains("error") ? told["error"]["remedies"] : json();
  };
  EXPECT_THAT(remedies(json::object()), ElementsAre("wheelbase", "robot"));
  EXPECT_THAT(remedies({{"wheelbase", 0.29}, {"wheel_diameter", 0.084}}),
              ElementsAre("counts_per_turn", "robot"));
  EXPECT_THAT(remedies(with(sizes(), {{"swap_wheels", true}})), ElementsAre("swap_wheels", "up"));
  EXPECT_THAT(remedies(with(sizes(), {{"truth_topic", "/mocap"}})), ElementsAre("truth_topic"))
      << "no file is a bag";
  EXPECT_EQ(sentence("calibrate", json::object()),
            "there are no drives: give files of wheels and of ground truth");
  EXPECT_EQ(sentence("calibrate", {{"drives", {{{"wheels", "wheels1.csv"}, {"truth", ""}}}}}),
            "there are 1 files of wheels and 0 of ground truth: each drive needs both");
  EXPECT_EQ(
      sentence("calibrate",
               {{"drives",
                 {{{"wheels", "wheels1.csv"}, {"truth", ""}}, {{"wheels", ""}, {"truth", "take2.csv"}}}}}),
      "drive 1 has no ground truth")
      << "they are not one drive";
}

TEST_F(DataCalls, NoQuestionLeadsOutOfTheFolder) {
  std::ofstream(at("inside.csv")) << "time_s,left_counts,right_counts\n0,0,0\n1,2,3\n";
  for (const char* name : {"../inside.csv", "/etc/passwd", "..", ".", "a/b.csv", "folder/../inside.csv"}) {
    EXPECT_THAT(sentence("inspect", {{"files", {name}}}), HasSubstr("is no name of a file")) << name;
    EXPECT_THAT(sentence("calibrate", {{"robot", name}}), HasSubstr("is no name of a file")) << name;
    EXPECT_THAT(sentence("calibrate", {{"drives", {{{"wheels", name}, {"truth", name}}}}}),
                HasSubstr("is no name of a file"))
        << name;
  }
  EXPECT_THAT(sentence("inspect", {{"files", {""}}}), HasSubstr("is no name of a file"));
  EXPECT_EQ(sentence("inspect", {{"files", {".made"}}}),
            "'.made' is where results are kept: rename the file");
}

TEST_F(DataCalls, WrongTypesAndValuesAreRefusedInASentence) {
  EXPECT_EQ(sentence("inspect", {{"files", "a.csv"}}), "files is no list");
  EXPECT_EQ(sentence("inspect", {{"files", {1}}}), "files has an entry that is no text");
  EXPECT_EQ(sentence("inspect", {{"roles", 1}}), "roles is no object");
  EXPECT_EQ(sentence("inspect", {{"files", {"a.csv"}}, {"roles", {{"a.csv", "lidar"}}}}),
            "a file can be wheels, truth, both or none, and not 'lidar'");
  EXPECT_EQ(sentence("calibrate", {{"wheelbase", "0.3"}}), "wheelbase is no number");
  EXPECT_EQ(sentence("calibrate", {{"wheelbase", 290}}), "wheelbase is 290, and must be from 0.02 to 10");
  EXPECT_EQ(sentence("calibrate", {{"per_interval", 1}}), "per_interval is neither true nor false");
  EXPECT_EQ(sentence("calibrate", {{"drives", 1}}), "drives is no list");
  EXPECT_EQ(sentence("calibrate", {{"drives", {1}}}), "drives has an entry that is no object");
  EXPECT_EQ(sentence("calibrate", {{"truth_unit", "ft"}}),
            "truth_unit is 'ft', and must be one of m, cm, mm");
}

/// The raw files of a real robot under OptiTrack (Sousa et al.), as their owners wrote them.
TEST_F(DataCalls, RawFilesOfARealRobotGiveTheFactorsOfTheLibraries) {
  const fs::path source = support::shared_data() / "sousa_optiodom/square/231220200029";
  if (!fs::exists(source)) GTEST_SKIP() << "not at hand: " << source.string();
  json files = json::array();
  for (const auto& entry : fs::directory_iterator(source)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with("_odo.csv") && !name.ends_with("_opti.csv.gz")) continue;
    fs::copy(entry.path(), at(name));
    files.push_back(name);
  }
  const json stated = {{"wheel_columns", "time_s,left_counts,right_counts"},
                       {"per_interval", true},
                       {"wheel_diameter", 0.084},
                       {"counts_per_turn", 43.7 * 64},
                       {"wheelbase", 0.2}};
  const json found = inspected(with(stated, {{"files", files}}));
  ASSERT_EQ(found["drives"].size(), 6U) << found["drives"];
  const json told = ask("calibrate", with(stated, {{"drives", found["drives"]}}));
  ASSERT_TRUE(told.contains("result")) << told;
  importing::ImportChoices choices;
  choices.geometry.wheel_diameter_m = 0.084;
  choices.geometry.counts_per_turn = 43.7 * 64;
  choices.geometry.wheelbase_m = 0.2;
  choices.wheels.table = {"time_s,left_counts,right_counts", true};
  std::vector<importing::DriveFiles> pairs;
  for (int run = 1; run <= 6; ++run) {
    const std::string stem = fmt::format("231220200029_run-{:02}", run);
    pairs.push_back({source / (stem + "_odo.csv"), source / (stem + "_opti.csv.gz")});
  }
  const experiment::Calibration expected = experiment::calibrate(importing::import_drives(pairs, choices).set,
                                                                 {experiment::MethodChoice::Family::ml, {}});
  EXPECT_EQ(told["result"]["calibration"]["c_R"], expected.factors.c_r);
  EXPECT_EQ(told["result"]["calibration"]["c_L"], expected.factors.c_l);
  EXPECT_EQ(told["result"]["calibration"]["b_m"], expected.factors.b_m);
}

}  // namespace
}  // namespace astro::page
