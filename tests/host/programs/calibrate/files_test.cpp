#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/host/calibration/ml_drives.hpp"
#include "tests/host/import/drives/drive_files.hpp"
#include "tests/host/import/drives/file_samples.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/programs/terminal_program.hpp"

// `calibrate files`, `calibrate bag`, `calibrate check` and `inspect` on what other programs recorded.
namespace astro {
namespace {

namespace fs = std::filesystem;
using support::astrolabe;
using support::Outcome;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr int kWrongUsage = 2, kNotBetter = 3;

class Files : public testing::Test {
 protected:
  static std::vector<calibration::Trajectory> drives(int count, std::uint64_t seed = calibration::kSeed) {
    simulation::study::DriveModel model = calibration::astro_drive();
    model.metres_per_count = test::kMetresPerCount;
    model.clock_offset_s = 0.031;
    return calibration::squares(model, count, 2, seed);
  }

  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }

  std::vector<std::string> pairs(int count, const std::string& name = "drive") {
    std::vector<std::string> words;
    int i = 0;
    for (const calibration::Trajectory& run : drives(count)) {
      const std::string stem = at(name + std::to_string(++i));
      words.insert(words.end(), {"--wheels", test::write_counts(stem + ".csv", run).string(), "--truth",
                                 test::write_motive(stem + "-take.csv", run).string()});
    }
    return words;
  }

  static Outcome run(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return astrolabe(words);
  }

  static std::vector<std::string> sizes() {
    return {"--wheel-diameter", "0.084", "--counts-per-turn", "4096", "--wheelbase", "0.29"};
  }

  Outcome calibrated(int count, std::vector<std::string> more = sizes()) {
    std::vector<std::string> words{"calibrate", "files"};
    for (const std::string& word : pairs(count)) words.push_back(word);
    return run(words, more);
  }

  test::TemporaryFolder folder_;
};

TEST_F(Files, AreCalibratedFromOneCommandWithErrorsAndAVerdict) {
  std::vector<std::string> more = sizes();
  more.insert(more.end(), {"--out", at("calib.toml"), "--json"});
  const Outcome outcome = calibrated(4, more);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = support::parse_json(outcome.out);
  const calibration::WheelFactors actual = calibration::astro_drive().actual;
  EXPECT_NEAR(json["c_R"], actual.c_r, 4 * json["standard_errors"]["c_R"].get<double>());
  EXPECT_NEAR(json["b_m"], actual.b_m, 4 * json["standard_errors"]["b_m"].get<double>());
  EXPECT_EQ(json["verdict"]["verdict"], "better");
  EXPECT_EQ(json["verdict"]["drives"].size(), 4);
  EXPECT_THAT(outcome.err, HasSubstr("drive1: "));
  EXPECT_THAT(outcome.err, HasSubstr("poses of 'ASTRO' (Motive CSV 1.23) at 60 Hz, 0 lost; y is up"));
  EXPECT_TRUE(fs::exists(at("calib.toml")));
}

// The clocks of these drives are 31 ms apart, which is there to be found unless it is said that they are one clock.
TEST_F(Files, AreTakenByOneClockIfAPersonSaysThatItIsOne) {
  const auto clocks = [&](const std::string& said) {
    std::vector<std::string> more = sizes();
    more.insert(more.end(), {"--clock", said, "--json"});
    const Outcome outcome = calibrated(4, more);
    const nlohmann::json json = support::parse_json(outcome.out);
    EXPECT_EQ(json["clock_known"], said == "known") << outcome.err;
    std::vector<double> offsets_s;
    for (const nlohmann::json& run : json["runs"]) offsets_s.push_back(run["clock_offset_s"]);
    return offsets_s;
  };
  using testing::Each, testing::SizeIs;
  EXPECT_THAT(clocks("estimated"), testing::AllOf(SizeIs(4), Each(testing::Ne(0))));
  EXPECT_THAT(clocks("known"), testing::AllOf(SizeIs(4), Each(0)));
}

TEST_F(Files, AreCheckedWithACalibrationThatHasNotSeenThem) {
  std::vector<std::string> more = sizes();
  more.insert(more.end(), {"--out", at("calib.toml")});
  ASSERT_EQ(calibrated(4, more).code, 0);
  std::vector<std::string> words{"calibrate", "check", "--with", at("calib.toml"), "--json"};
  int i = 0;
  for (const calibration::Trajectory& run : drives(2, 77)) {
    const std::string stem = at("unseen" + std::to_string(++i));
    words.insert(words.end(), {"--wheels", test::write_degrees(stem + ".txt", run).string(), "--truth",
                               test::write_tum(stem + ".tum", run).string()});
  }
  // Angles need no counts, and the calibration from counts holds for them.
  const Outcome outcome = run(words, {"--wheel-diameter", "0.084", "--wheelbase", "0.29"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = support::parse_json(outcome.out);
  // Slip alone leaves about 60 mm, which no factors change.
  EXPECT_LT(json[1]["end_m"].get<double>(), 0.5 * json[0]["end_m"].get<double>());
}

// The body sits 7 mm further to the left on Tuesday: less than drives tell apart by themselves, because the slip of a drive
// shifts the body as much.
TEST_F(Files, OfTwoFoldersPoolAlthoughTheBodyWasMountedAnewIfAFolderIsASession) {
  simulation::study::DriveModel model = calibration::astro_drive();
  model.metres_per_count = test::kMetresPerCount;
  std::vector<std::string> drives;
  std::uint64_t seed = 5;
  std::map<std::string, calibration::LeverArm> mounted;
  for (const std::string day : {"monday", "tuesday"}) {
    fs::create_directory(at(day));
    mounted[day] = model.lever;
    int i = 0;
    for (const calibration::Trajectory& run : calibration::squares(model, 3, 2, ++seed)) {
      const std::string stem = at(day + "/drive" + std::to_string(++i));
      drives.insert(drives.end(), {"--wheels", test::write_counts(stem + ".csv", run).string(), "--truth",
                                   test::write_motive(stem + "-take.csv", run).string()});
    }
    model.lever.y_m += 0.007;
  }
  const auto run_with = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), drives.begin(), drives.end());
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words, sizes());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  };
  const nlohmann::json found = support::parse_json(run_with({"calibrate", "files"}, {"--json"}).out);
  ASSERT_EQ(found["sessions"].size(), 1);
  EXPECT_TRUE(found["sessions"][0]["name"].is_null());
  EXPECT_THAT(run_with({"calibrate", "files"}, {}).out, HasSubstr("--session-per-folder"));

  const Outcome text = run_with({"calibrate", "files"}, {"--session-per-folder", "--out", at("calib.toml")});
  EXPECT_THAT(text.out, testing::ContainsRegex("of\\s2\\ssessions"));
  EXPECT_THAT(text.out, testing::ContainsRegex("in\\s'monday'\\sat\\sx"));
  EXPECT_THAT(text.out, testing::ContainsRegex("and\\sin\\s'tuesday'\\sat\\sx"));
  const nlohmann::json named =
      support::parse_json(run_with({"calibrate", "files"}, {"--session-per-folder", "--json"}).out);
  ASSERT_EQ(named["sessions"].size(), 2);
  for (const nlohmann::json& session : named["sessions"])
    EXPECT_NEAR(session["lever_arm"]["y_m"], mounted.at(session["name"]).y_m,
                4 * session["lever_arm_se"]["y_m"].get<double>());
  EXPECT_EQ(named["runs"][0]["session"], 0);
  EXPECT_EQ(named["runs"][3]["name"], "tuesday/drive1");
  EXPECT_EQ(named["runs"][3]["session"], 1);
  EXPECT_NEAR(named["b_m"], model.actual.b_m, 4 * named["standard_errors"]["b_m"].get<double>());

  // The drives of each day start from where the body sat on that day.
  const std::vector<std::string> check{"calibrate", "check", "--with", at("calib.toml"), "--json"};
  const nlohmann::json pooled = support::parse_json(run_with(check, {}).out),
                       apart = support::parse_json(run_with(check, {"--session-per-folder"}).out);
  EXPECT_NE(apart[1]["path_m"], pooled[1]["path_m"]);
  run_with({"report", "--out", at("report.html")}, {"--session-per-folder"});
  std::ifstream file(at("report.html"));
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(page, HasSubstr("in &#39;tuesday&#39; at x"));
}

TEST_F(Files, AreCheckedWithTheWheelbaseOfSpinsAndThatOfGentleArcsIfACalibrationHasBoth) {
  std::ofstream(at("one.toml")) << "[parameters]\nc_R = 1.001\nc_L = 0.999\nb = 0.29\n";
  std::ofstream(at("two.toml")) << "[parameters]\nc_R = 1.001\nc_L = 0.999\nb = 0.29\ne = 0.03\n";
  std::vector<std::string> words{"calibrate", "check", "--with", at("one.toml"), "--with", at("two.toml")};
  for (const std::string& word : pairs(1)) words.push_back(word);
  std::string text = run(words, sizes()).out;
  std::ranges::replace(text, '\n', ' ');
  EXPECT_THAT(
      text, HasSubstr("two.toml: e = 0.0300, spins turn about b = 290.000 mm, gentle arcs about b (1 + e) = "
                      "298.700 mm."));
  EXPECT_THAT(text, testing::Not(HasSubstr("one.toml: e")));
  EXPECT_THAT(text, testing::Not(HasSubstr("carried: e")));
}

/// What the robot file says is what the robot carried, and is not where e begins.
TEST_F(Files, OfARobotThatCarriesAnEAreReckonedWithItAndGetTheirOwn) {
  const std::string robot =
      "[parameters]\nwheel_diameter = 0.084\ncounts_per_motor_rev = 4096\nb = 0.29\nc_R = 1\nc_L = 1\n";
  std::ofstream(at("plain.toml")) << robot;
  std::ofstream(at("curved.toml")) << robot << "e = 0.05\n";
  const Outcome found = calibrated(4, {"--robot", at("curved.toml"), "--out", at("calib.toml")});
  ASSERT_EQ(found.code, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("\ne         0.00"));

  std::vector<std::string> words{"calibrate", "check", "--with", at("calib.toml"), "--json"};
  for (const std::string& word : pairs(2)) words.push_back(word);
  const nlohmann::json curved = support::parse_json(run(words, {"--robot", at("curved.toml")}).out),
                       plain = support::parse_json(run(words, {"--robot", at("plain.toml")}).out);
  EXPECT_EQ(curved[0]["e"], 0.05);
  EXPECT_EQ(plain[0]["e"], 0);
  EXPECT_NE(curved[0]["path_m"], plain[0]["path_m"]);
  EXPECT_EQ(curved[1]["path_m"], plain[1]["path_m"]) << "what is judged counts for both";
}

TEST_F(Files, OfARobotThatIsRightAlreadyGiveAnAdviceAndAnExitCodeOfTheirOwn) {
  const calibration::WheelFactors actual = calibration::astro_drive().actual;
  std::ofstream(at("robot.toml")) << fmt::format(
      "[parameters]\nwheel_diameter = 0.084\ncounts_per_motor_rev = 4096\nb = {}\nc_R = {}\nc_L = {}\n",
      actual.b_m, actual.c_r, actual.c_l);
  const Outcome outcome = calibrated(4, {"--robot", at("robot.toml"), "--out", at("calib.toml")});
  EXPECT_EQ(outcome.code, kNotBetter) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Keep what it carries."));
  EXPECT_THAT(outcome.err, HasSubstr("although it is not shown to be better"));
  std::ifstream file(at("calib.toml"));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(text, testing::AnyOf(HasSubstr("verdict = \"undecided\""), HasSubstr("verdict = \"worse\"")));
}

TEST_F(Files, InABagAreCalibratedWithTheControllersParameters) {
  std::ofstream(at("base.yaml")) << "diff_drive_controller:\n  ros__parameters:\n    wheel_separation: 0.29\n"
                                    "    wheel_radius: 0.042\n    left_wheel_names: [\"wheel_left_joint\"]\n"
                                    "    right_wheel_names: [\"wheel_right_joint\"]\n";
  std::vector<std::string> words{"calibrate", "bag", "--robot", at("base.yaml"), "--json"};
  int i = 0;
  for (const calibration::Trajectory& run : drives(2))
    words.push_back(test::write_bag(at("bag" + std::to_string(++i)), run).string());
  const Outcome outcome = astrolabe(words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = support::parse_json(outcome.out);
  EXPECT_NEAR(json["c_R"], calibration::astro_drive().actual.c_r,
              4 * json["standard_errors"]["c_R"].get<double>());
}

TEST_F(Files, InABagAreCalibratedWithTheDescriptionThatWasRecordedBesideThem) {
  const auto wheel = [](const std::string& name, const std::string& y) {
    return "<link name='" + name +
           "'><visual><geometry><cylinder radius='0.042' length='0.02'/></geometry></visual>"
           "</link><joint name='" +
           name + "_joint' type='continuous'><parent link='base'/><child link='" + name +
           "'/><origin xyz='0 " + y + " 0.042'/><axis xyz='0 1 0'/></joint>";
  };
  const std::string urdf =
      "<robot name='r'>" + wheel("wheel_left", "0.145") + wheel("wheel_right", "-0.145") + "</robot>";
  std::vector<std::string> words{"calibrate", "bag", "--json"};
  int i = 0;
  for (const calibration::Trajectory& run : drives(2)) {
    // Of the second bag the description was not recorded.
    const std::string recorded = i++ == 0 ? urdf : "";
    words.push_back(test::write_bag(at("bag" + std::to_string(i)), run, test::z_up, recorded).string());
  }
  const Outcome outcome = astrolabe(words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("/robot_description has wheels of 0.084 m, 0.29 m apart"));
  const nlohmann::json json = support::parse_json(outcome.out);
  EXPECT_NEAR(json["c_R"], calibration::astro_drive().actual.c_r,
              4 * json["standard_errors"]["c_R"].get<double>());
  // What a person says counts more.
  words.insert(words.end(), {"--wheelbase", "0.3", "--wheel-diameter", "0.084"});
  EXPECT_THAT(astrolabe(words).err, testing::Not(HasSubstr("robot_description")));
}

TEST_F(Files, AreReportedDriveByDrive) {
  std::vector<std::string> words{"report", "--out", at("report.html")};
  for (const std::string& word : pairs(3)) words.push_back(word);
  const Outcome outcome = run(words, sizes());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::ifstream file(at("report.html"));
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(page, HasSubstr("Better than what the robot carries"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">drive2</th>"));
  EXPECT_EQ(astrolabe({"report"}).code, kWrongUsage);
  EXPECT_EQ(astrolabe({"report", folder_.path().string(), "--with", "x.toml"}).code, kWrongUsage);
}

TEST_F(Files, AreNeverOverwrittenByWhatIsMadeOfThem) {
  const auto text_of = [](const std::string& path) {
    std::ifstream file(path);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  const std::vector<std::string> some = pairs(1);
  const std::string wheels = text_of(some[1]);
  std::vector<std::string> report{"report", "--out", some[1]};
  report.insert(report.end(), some.begin(), some.end());
  const Outcome refused = run(report, sizes());
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("exists and is no report of this program"));
  EXPECT_EQ(text_of(some[1]), wheels);

  const std::string robot =
      "[parameters]\nwheel_diameter = 0.084\ncounts_per_motor_rev = 4096\nb = 0.29\nc_R = 1\nc_L = 1\n";
  std::ofstream(at("robot.toml")) << robot;
  const Outcome same = calibrated(2, {"--robot", at("robot.toml"), "--out", at("robot.toml")});
  EXPECT_EQ(same.code, 1);
  EXPECT_THAT(same.err, HasSubstr("is read, and would be overwritten"));
  EXPECT_EQ(text_of(at("robot.toml")), robot);

  std::ofstream(at("controller.yaml")) << "controller_server:\n  ros__parameters:\n    rate: 20.0\n";
  std::ofstream(at("calib.toml")) << "[parameters]\nc_R = 1.001\nc_L = 0.999\nb = 0.29\n";
  const auto exported = [&](const std::string& to) {
    return astrolabe({"calibrate", "export", at("calib.toml"), "--to", at(to), "--wheel-radius", "0.042",
                      "--wheel-separation", "0.29"});
  };
  EXPECT_EQ(exported("controller.yaml").code, 1);
  EXPECT_THAT(text_of(at("controller.yaml")), HasSubstr("rate: 20.0"));
  EXPECT_EQ(exported("calib.toml").code, 1);
  for (const char* own : {"wheels.yaml", "wheels.json", "wheels.toml"})
    for (int again = 0; again < 2; ++again)
      EXPECT_EQ(exported(own).code, 0) << own << ' ' << exported(own).err;
}

TEST_F(Files, ThatDoNotPairAreWrongUsage) {
  const std::vector<std::string> some = pairs(1);
  EXPECT_EQ(astrolabe({"calibrate", "files", "--wheels", some[1], "--wheelbase", "0.3"}).code, kWrongUsage);
  EXPECT_EQ(astrolabe({"calibrate", "files"}).code, kWrongUsage);
  EXPECT_EQ(astrolabe({"calibrate", "check", "--with", "x.toml"}).code, kWrongUsage);
}

TEST_F(Files, AreNotReadWithOptionsThatApplyToOtherKindsOfFiles) {
  std::vector<std::string> words{"calibrate", "files"};
  for (const std::string& word : pairs(1)) words.push_back(word);
  const Outcome outcome = run(words, {"--truth-topic", "/tracker/pose"});
  EXPECT_EQ(outcome.code, kWrongUsage);
  EXPECT_THAT(outcome.err, HasSubstr("--truth-topic does not apply here"));
  EXPECT_EQ(astrolabe({"inspect", words[3], "--truth-topic", "/tracker/pose"}).code, kWrongUsage);
  EXPECT_EQ(astrolabe({"inspect", words[5], "--per-interval"}).code, kWrongUsage);
  EXPECT_EQ(astrolabe({"report", folder_.path().string(), "--up", "y"}).code, kWrongUsage);
  EXPECT_EQ(astrolabe({"report", folder_.path().string(), "--session-per-folder"}).code, kWrongUsage);
  EXPECT_EQ(astrolabe({"calibrate", "check", folder_.path().string(), "--with", "x.toml", "--up", "y"}).code,
            kWrongUsage);
  EXPECT_EQ(astrolabe({"calibrate", "bag", "drive", "--body", "ASTRO"}).code, kWrongUsage);
}

TEST_F(Files, WhoseSizesAreNotKnownAreAskedForByTheirOptions) {
  const Outcome outcome = calibrated(1, {"--wheel-diameter", "0.084", "--wheelbase", "0.29"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("give --counts-per-turn, or a file with --robot"));
}

TEST_F(Files, AreInspected) {
  const calibration::Trajectory drive = drives(1)[0];
  const Outcome take = astrolabe({"inspect", test::write_motive(at("take.csv"), drive).string()});
  EXPECT_EQ(take.code, 0) << take.err;
  EXPECT_THAT(take.out, StartsWith("Motive CSV 1.23: 1 body, lengths in Millimeters"));
  EXPECT_THAT(take.out, HasSubstr("ASTRO"));
  const Outcome wheels =
      astrolabe({"inspect", test::write_counts(at("ticks.csv"), drive).string(), "--json"});
  EXPECT_EQ(support::parse_json(wheels.out)["kind"], "wheels") << wheels.err;
  EXPECT_EQ(support::parse_json(wheels.out)["unit"], "counts");
  const fs::path bag_folder = test::write_bag(at("bag"), drive);
  const Outcome bag = astrolabe({"inspect", bag_folder.string()});
  EXPECT_THAT(bag.out, HasSubstr("/tracker/pose"));
  EXPECT_THAT(bag.out, HasSubstr("wheels: wheel_left_joint (left)"));
  const Outcome poses =
      astrolabe({"inspect", bag_folder.string(), "--truth-topic", "/tracker/pose", "--json"});
  EXPECT_EQ(support::parse_json(poses.out)["bodies"][0]["samples"], drive.truth.size()) << poses.err;
  std::ofstream(at("noise.bin")) << "nothing that anybody knows\n1 2 3\n";
  const Outcome unknown = astrolabe({"inspect", at("noise.bin")});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("noise.bin"));
}

TEST_F(Files, OfWhichOnlyTheEndsWereMeasuredAreEnough) {
  simulation::study::DriveModel model = calibration::astro_drive();
  model.metres_per_count = test::kMetresPerCount;
  std::vector<std::string> words{"calibrate", "files"};
  for (const calibration::Trajectory& run : calibration::varied_drives(model)) {
    const std::string stem = at("drive" + std::to_string(words.size() / 4 + 1));
    std::ofstream ends(stem + "-ends.csv");
    ends << "x_m,y_m,theta_rad\n";  // nobody with a tape has times
    for (const calibration::BodySample& end : {run.truth.front(), run.truth.back()})
      ends << end.x_m << ',' << end.y_m << ',' << end.theta_rad << '\n';
    words.insert(words.end(), {"--wheels", test::write_counts(stem + ".csv", run).string(), "--truth",
                               stem + "-ends.csv"});
  }
  const Outcome outcome =
      run(words, {"--wheel-diameter", "0.084", "--counts-per-turn", "4096", "--wheelbase", "0.29", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json found = support::parse_json(outcome.out);
  for (const auto& [name, actual] :
       {std::pair{"c_R", model.actual.c_r}, {"c_L", model.actual.c_l}, {"b_m", model.actual.b_m}})
    EXPECT_NEAR(found[name].get<double>(), actual, 3 * found["standard_errors"][name].get<double>()) << name;
  EXPECT_THAT(outcome.err, Not(HasSubstr("unit of length")));
  EXPECT_EQ(found["noise"]["given"], false);
  const Outcome inspected = astrolabe({"inspect", at("drive1-ends.csv")});
  EXPECT_THAT(inspected.out, HasSubstr("where a drive began and where it ended")) << inspected.err;
  EXPECT_THAT(inspected.out, HasSubstr("calibrate files --wheels WHEELS --truth"));
}

TEST_F(Files, AreInspectedWithTheCommandThatCalibrates) {
  const calibration::Trajectory drive = drives(1)[0];
  const std::string ticks = test::write_counts(at("the ticks.csv"), drive).string(),
                    take = test::write_motive(at("take.csv"), drive).string(),
                    bag = test::write_bag(at("bag"), drive).string();
  test::save(at("drive.bag"), test::ros1_bag_of_counts(drive));
  struct Case {
    std::string file;
    std::vector<std::pair<std::string, std::string>> filled_in;  // in place of capitals
  };
  for (const Case& one : {Case{ticks, {{"TRUTH", take}, {"COUNTS", "4096"}}},
                          Case{take, {{"WHEELS", "'" + ticks + "'"}, {"COUNTS", "4096"}}}, Case{bag, {}},
                          Case{at("drive.bag"), {{"TOPIC", "/vicon/tf"}, {"COUNTS", "4096"}}}}) {
    const Outcome inspected = astrolabe({"inspect", one.file, "--json"});
    ASSERT_EQ(inspected.code, 0) << inspected.err;
    std::string command = support::parse_json(inspected.out)["command"];
    const auto fill_in = [&](const std::string& capitals, const std::string& value) {
      for (std::size_t at = 0; (at = command.find(capitals, at)) != command.npos; at += value.size())
        command.replace(at, capitals.size(), value);
    };
    for (const auto& [capitals, value] : one.filled_in) fill_in(capitals, value);
    fill_in("--wheel-diameter METRES", "--wheel-diameter 0.084");
    fill_in("--wheelbase METRES", "--wheelbase 0.29");
    ASSERT_THAT(command, StartsWith("astrolabe "));
    command.replace(0, std::string("astrolabe").size(), ASTROLABE_PROGRAM);
    support::Program shell({"/bin/sh", "-c", command + " --json"});
    EXPECT_EQ(shell.wait(), 0) << command << '\n' << shell.err();
    EXPECT_NEAR(support::parse_json(shell.out())["b_m"].get<double>(), calibration::astro_drive().actual.b_m,
                1e-3)
        << command;
  }
}

TEST_F(Files, InBagsOfRos1AreInspectedAndCalibratedByTheTopicsOfTheWheels) {
  test::save(at("drive.bag"), test::ros1_bag_of_counts(drives(1)[0]));
  const Outcome inspected = astrolabe({"inspect", at("drive.bag")});
  EXPECT_THAT(inspected.out, StartsWith("ROS 1 bag of 1 file."));
  EXPECT_THAT(inspected.out,
              HasSubstr("'calibrate' takes the wheels from /lwheel_ticks,/rwheel_ticks (counts)."));
  const auto calibrated = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"calibrate", "bag", at("drive.bag"), "--truth-topic", "/vicon/tf"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words, sizes());
  };
  const Outcome found = calibrated({"--json"});
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_THAT(found.err, HasSubstr("the wheels are /lwheel_ticks,/rwheel_ticks in counts"));
  EXPECT_NEAR(support::parse_json(found.out)["b_m"].get<double>(), calibration::astro_drive().actual.b_m,
              1e-3);
  const Outcome named =
      calibrated({"--wheels-topic", "/rwheel_ticks,/lwheel_ticks", "--swap-wheels", "--json"});
  EXPECT_EQ(support::parse_json(named.out)["b_m"], support::parse_json(found.out)["b_m"]) << named.err;
  const Outcome half = calibrated({"--wheels-topic", "/lwheel_ticks"});
  EXPECT_EQ(half.code, 1);
  EXPECT_THAT(half.err, HasSubstr("--wheels-topic TOPIC:LEFT,RIGHT"));
  for (const char* joints : {"a+b,c", "a,b,c", "a+,b+c"})
    EXPECT_EQ(calibrated({"--joints", joints}).code, kWrongUsage);
}

TEST_F(Files, ThatRobotsCarryAreNotReplacedWithoutAQuestion) {
  support::Simulator simulator;
  std::ofstream(at("calib.toml"))
      << "[parameters]\nc_R = 1.001\nc_L = 0.999\nb = 0.29\n[calibration]\nmethod = "
         "\"ml\"\nabsolute = true\n[verdict]\nverdict = \"undecided\"\nsentence = \"Not "
         "shown to be better.\"\n";
  const Outcome asked = astrolabe({"upload", at("calib.toml"), "--port", simulator.port()});
  EXPECT_EQ(asked.code, kNotBetter);  // nobody is there to answer
  EXPECT_THAT(asked.err, HasSubstr("warning: Not shown to be better."));
  support::TerminalProgram upload(
      {ASTROLABE_PROGRAM, "upload", at("calib.toml"), "--port", simulator.port()});
  ASSERT_TRUE(upload.shows("Load these into the robot all the same? [y/N]")) << upload.seen();
  upload.type("y\n");
  EXPECT_EQ(upload.wait(), 0) << upload.seen();
}

}  // namespace
}  // namespace astro
