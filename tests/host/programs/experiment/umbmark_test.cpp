#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "tests/support/base/columns.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/robots/watched_drive.hpp"

// The whole experiment with the real program over a real pty.
namespace astro {
namespace {

namespace fs = std::filesystem;
using support::astrolabe;
using support::Simulator;
using testing::HasSubstr;

std::vector<std::string> umbmark(const Simulator& simulator, const std::string& out,
                                 std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"umbmark", "--port", simulator.port(), "--truth", "sim",
                                     "--out",   out,      "--yes"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void expect_same_claim(const std::string& terminal, const fs::path& report) {
  std::ifstream file(report);
  const std::string html{std::istreambuf_iterator<char>(file), {}};
  const std::string start = "E_max_syst is ";
  const std::size_t from = terminal.find(start) + start.size();
  const std::string claim = terminal.substr(from, terminal.find(':', from) - from);
  EXPECT_THAT(claim, HasSubstr("times smaller"));
  EXPECT_THAT(html, HasSubstr("<strong>" + claim + "</strong>"));
}

TEST(Umbmark, CalibratesASimulatedRobotOverAPty) {
  const Simulator simulator({"--fast", "--true-ed", "1.00416", "--true-wheelbase", "0.28861", "--seed", "1"});
  const std::string out = (simulator.folder() / "x").string();
  const support::Outcome outcome =
      astrolabe(umbmark(simulator, out, {"--runs", "5", "--side", "3", "--json"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = support::parse_json(outcome.out);
  const double before_m = json["before"]["E_max_syst_m"], after_m = json["after"]["E_max_syst_m"];
  std::printf("over a pty: E_max_syst %.1f mm -> %.1f mm, %.1f times smaller\n", 1000 * before_m,
              1000 * after_m, before_m / after_m);
  EXPECT_NEAR(before_m, 0.42, 0.08);  // five runs measure it to some 0.04 m
  EXPECT_GE(before_m / after_m, 5);
  for (const char* phase : {"before", "after"})
    for (const char* direction : {"cw", "ccw"})
      for (const char* key : {"x_cg_m", "y_cg_m", "theta_cg_rad", "r_cg_m", "rms_x_m", "rms_y_m", "rms_r_m"})
        EXPECT_TRUE(json[phase][direction][key].is_number()) << phase << ' ' << direction << ' ' << key;
  for (const char* set : {"old", "new", "standard_errors"})
    for (const char* key : {"c_R", "c_L", "b_m"})
      EXPECT_TRUE(json["parameters"][set][key].is_number()) << set << key;
  EXPECT_TRUE(fs::exists(json["report"].get<std::string>()));

  const nlohmann::json b =
      support::parse_json(astrolabe({"params", "get", "b", "--port", simulator.port(), "--json"}).out);
  EXPECT_NEAR(b["value"].get<double>(), json["parameters"]["new"]["b_m"].get<double>(), 1e-9)
      << "the robot holds what the result says, in whole nanometres";

  const support::Outcome compared = astrolabe({"compare", out});
  EXPECT_EQ(compared.code, 0);
  EXPECT_EQ(astrolabe({"report", out, "--out", (simulator.folder() / "again.html").string()}).code, 0);
  EXPECT_GT(fs::file_size(simulator.folder() / "again.html"), 1'000'000U);
  expect_same_claim(compared.out, simulator.folder() / "again.html");
  const support::Outcome runs = astrolabe({"calibrate", "runs", out + "/before", "--json"});
  // The same runs in another order: equal except for rounding.
  EXPECT_NEAR(support::parse_json(runs.out)["c_R"].get<double>(),
              json["phases"][0]["estimate"]["c_R"].get<double>(), 1e-9);
  const support::Outcome two = astrolabe({"compare", out + "/before", out + "/after", "--json"});
  EXPECT_EQ(support::parse_json(two.out)["improvement"], json["improvement"]);
}

TEST(Umbmark, NamesEOnTheTerminalInTheReportInTheFileAndOnTheRobot) {
  const Simulator simulator({"--fast", "--true-ed", "1.00416", "--true-wheelbase", "0.28861", "--true-e",
                             "0.03", "--slip", "2.645e-6", "--seed", "1"});
  const std::string out = (simulator.folder() / "x").string(), calib = out + "/calib-before.toml";
  const support::Outcome outcome = astrolabe(umbmark(simulator, out));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("gentle arcs about b (1 + e)"));
  std::ifstream report(out + "/report.html");
  EXPECT_THAT((std::string{std::istreambuf_iterator<char>(report), {}}),
              HasSubstr("gentle arcs about b (1 + e)"));
  const nlohmann::json e =
      support::parse_json(astrolabe({"params", "get", "e", "--port", simulator.port(), "--json"}).out);
  EXPECT_NEAR(e["value"].get<double>(), 0.03, 0.015);  // four standard errors
  const support::Outcome yaml =
      astrolabe({"calibrate", "export", calib, "--to", (simulator.folder() / "wheels.yaml").string()});
  EXPECT_EQ(yaml.code, 0);
  EXPECT_THAT(yaml.err, HasSubstr("warning: diff_drive_controller knows one wheelbase"));

  const std::string without = (simulator.folder() / "without.toml").string();
  std::ifstream file(calib);
  std::ofstream copy(without);
  bool parameters = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('[')) parameters = line == "[parameters]";
    copy << (parameters && line.starts_with("e = ") ? "e = 0.0" : line) << '\n';
  }
  copy.close();
  const nlohmann::json judged = support::parse_json(
      astrolabe({"calibrate", "check", out + "/after", "--with", calib, "--with", without, "--json"}).out);
  ASSERT_EQ(judged.size(), 3U);
  EXPECT_NEAR(judged[1]["e"].get<double>(), e["value"].get<double>(), 1e-8);
  EXPECT_EQ(judged[2]["e"], 0);
  for (std::size_t i = 0; i < judged[1]["runs"].size(); ++i) {
    const auto heading = [&](std::size_t by) {
      return std::abs(judged[by]["runs"][i]["heading_rad"].get<double>());
    };
    std::printf("%s: heading %.1f mrad with e, %.1f mrad without\n",
                judged[1]["runs"][i]["name"].get<std::string>().c_str(), 1000 * heading(1),
                1000 * heading(2));
  }
}

TEST(Umbmark, EndsWithTheGyroOfARobotThatUsesOne) {
  const Simulator simulator({"--fast", "--gyro", "--seed", "2"});
  ASSERT_EQ(astrolabe({"params", "set", "gyro_axis=3", "--port", simulator.port()}).code, 0);
  const support::Outcome outcome = astrolabe(umbmark(simulator, (simulator.folder() / "x").string()));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("The gyro measures "));
  EXPECT_THAT(outcome.out, HasSubstr("by the headings of"));
  EXPECT_LE(support::widest_line(outcome.out), 80U) << outcome.out;
}

// With so little slip the two calibrations differ by far less than what robots change by from one day to another, whatever the
// drives are. The wheelbase of gentle arcs is beyond what these drives show.
TEST(Umbmark, YesLoadsNothingThatIsNotBetterAndEndsWithAReportOfWhatWasDriven) {
  const Simulator simulator({"--fast", "--slip", "1e-8"});
  const auto run = [&](const char* name) {
    return astrolabe(
        umbmark(simulator, (simulator.folder() / name).string(), {"--runs", "2", "--no-extras"}));
  };
  const auto c_r = [&] {
    return astrolabe({"params", "get", "c_R", "--port", simulator.port(), "--json"}).out;
  };
  const support::Outcome first = run("first");
  ASSERT_EQ(first.code, 0) << first.err;
  const std::string carried = c_r();
  const support::Outcome second = run("second");  // of a robot that is calibrated already
  EXPECT_EQ(second.code, 3) << second.err;
  EXPECT_EQ(c_r(), carried);
  EXPECT_THAT(second.err, testing::AllOf(HasSubstr("the robot keeps what it carries"),
                                         HasSubstr("calib-before.toml"), HasSubstr("calibrate runs")));
  EXPECT_THAT(second.out, testing::AllOf(HasSubstr("E_max_syst"), HasSubstr("Keep what it carries."),
                                         HasSubstr("--force"), HasSubstr("report.html")));
  EXPECT_TRUE(fs::exists(simulator.folder() / "second" / "report.html"));
  EXPECT_FALSE(fs::exists(simulator.folder() / "second" / "after"));
}

TEST(Umbmark, CtrlCStopsTheRobotAndTheSameCommandGoesOn) {
  const Simulator simulator;
  const std::string out = (simulator.folder() / "x").string();
  const std::vector<std::string> arguments = umbmark(simulator, out, {"--runs", "2", "--no-extras"});
  std::vector<std::string> command = arguments;
  command.insert(command.begin(), ASTROLABE_PROGRAM);
  support::Program first(command);
  ASSERT_TRUE(support::eventually(
      [&] { return first.err().find("recorded before: square cw 1") != std::string::npos; }));
  first.send(SIGINT);
  ASSERT_EQ(first.wait(), 130) << "seven more runs were to come";
  const nlohmann::json info =
      support::parse_json(astrolabe({"info", "--port", simulator.port(), "--json"}).out);
  EXPECT_EQ(info["mode"], "disarmed");
  const support::Outcome second = astrolabe(arguments);
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_THAT(second.err, testing::Not(HasSubstr("recorded before: square cw 1")))
      << "it was recorded already";
  EXPECT_THAT(second.out, HasSubstr("report.html"));
}

TEST(Record, WritesWhatTheRobotDid) {
  const Simulator simulator;
  const std::string out = (simulator.folder() / "drive.mcap").string();
  const support::Outcome outcome =
      astrolabe({"record", "--port", simulator.port(), "--truth", "sim", "--seconds", "0.2", "--out", out,
                 "--csv", (simulator.folder() / "csv").string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("drive.mcap"));
  EXPECT_TRUE(fs::exists(simulator.folder() / "csv" / "odometry.csv"));
}

TEST(Record, CountsItsSecondsOnTheRobotsClock) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{}, {"--fast"}}) {
    const Simulator simulator(options);
    const fs::path csv = simulator.folder() / "csv";
    const support::Outcome outcome =
        astrolabe({"record", "--port", simulator.port(), "--seconds", "2", "--out",
                   (simulator.folder() / "drive.mcap").string(), "--csv", csv.string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::ifstream file(csv / "odometry.csv");
    const auto samples = std::count(std::istreambuf_iterator<char>(file), {}, '\n') - 1;
    // A sample each 10 ms; the end is checked every 50 ms, and a simulator in fast motion may run ahead by
    // 100 ms after bytes from the host.
    EXPECT_NEAR(static_cast<double>(samples), 200, 20) << (options.empty() ? "real time" : "--fast");
  }
}

TEST(Record, ReplacesNothing) {
  const Simulator simulator;
  const auto record = [&](const std::string& name, const std::string& csv) {
    return astrolabe({"record", "--port", simulator.port(), "--seconds", "0.2", "--out",
                      (simulator.folder() / name).string(), "--csv", (simulator.folder() / csv).string()});
  };
  ASSERT_EQ(record("a.mcap", "a").code, 0);
  const auto written = fs::last_write_time(simulator.folder() / "a.mcap");
  const support::Outcome again = record("a.mcap", "b");
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, testing::AllOf(HasSubstr("a.mcap' exists"), HasSubstr("another")));
  EXPECT_EQ(fs::last_write_time(simulator.folder() / "a.mcap"), written);
  EXPECT_THAT(record("b.mcap", "a").err, HasSubstr("a/odometry.csv' exists"));
}

TEST(Record, KnowsBeforeTheDriveWhatCannotBeWritten) {
  const support::Outcome folder = astrolabe({"record", "--port", "/nowhere", "--out", "/tmp"});
  EXPECT_EQ(folder.code, 1);
  EXPECT_THAT(folder.err, HasSubstr("'/tmp' is a folder"));
  EXPECT_THAT(astrolabe({"record", "--port", "/nowhere", "--out", "/proc/none/x.mcap"}).err,
              HasSubstr("/proc/none"));
}

/// 0 of a file that is not there.
std::uintmax_t bytes_of(const fs::path& file) {
  std::error_code none;
  const std::uintmax_t size = fs::file_size(file, none);
  return none ? 0 : size;
}

TEST(Record, KeepsWhatCameBeforeTheLinkWasLost) {
  Simulator simulator;
  const std::string out = (simulator.folder() / "drive.mcap").string();
  support::Program record({ASTROLABE_PROGRAM, "record", "--port", simulator.port(), "--out", out});
  ASSERT_TRUE(support::eventually([&] { return bytes_of(out + ".part") > 100'000; })) << record.err();
  simulator.program().send(SIGKILL);
  EXPECT_EQ(record.wait(), 1);
  EXPECT_THAT(record.err(), HasSubstr("what came before is in '" + out + "'"));
  EXPECT_TRUE(fs::exists(out));
}

// A limit on the size of files simulates a full disk.
std::vector<std::string> with_files_up_to(const std::string& blocks_of_512_bytes,
                                          std::vector<std::string> command) {
  command.insert(
      command.begin(),
      {"/bin/sh", "-c", "ulimit -f " + blocks_of_512_bytes + "; exec \"$0\" \"$@\"", ASTROLABE_PROGRAM});
  return command;
}

TEST(Record, InterruptedOnAFullDiskSaysThatNothingCouldBeWritten) {
  const Simulator simulator;
  const std::string out = (simulator.folder() / "drive.mcap").string();
  support::Program record(with_files_up_to("16", {"record", "--port", simulator.port(), "--out", out}));
  ASSERT_TRUE(support::eventually([&] { return bytes_of(out + ".part") == 16 * 512; })) << record.err();
  record.send(SIGINT);
  EXPECT_EQ(record.wait(), 1) << record.err();
  EXPECT_THAT(record.err(), testing::AllOf(HasSubstr("cannot write"), HasSubstr("drive.mcap")));
  EXPECT_FALSE(fs::exists(out));
}

using WatchedUmbmark = support::WatchedDrive;

TEST_F(WatchedUmbmark, InterruptedOnceTheLinkIsLostSaysSoAndDoesNotStartTheRunAgain) {
  Simulator& simulator = simulator_;
  const std::string out = (simulator.folder() / "x").string();
  std::vector<std::string> command = umbmark(simulator, out, {"--runs", "1", "--no-extras"});
  command.insert(command.begin(), ASTROLABE_PROGRAM);
  support::Program program(command);
  ASSERT_TRUE(has_gone(0.05)) << program.err();
  program.send(SIGSTOP);  // so that it receives both when it continues
  simulator.program().send(SIGKILL);
  simulator.program().wait();
  program.send(SIGINT);
  program.send(SIGCONT);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), HasSubstr("lost " + simulator.port()));
  EXPECT_THAT(program.err(), testing::Not(HasSubstr("was broken off")));
}

TEST(Umbmark, AsksEachQuestionOnceWhenTheInputHasEnded) {
  const Simulator simulator;
  const support::Outcome outcome =
      astrolabe({"umbmark", "--port", simulator.port(), "--truth", "manual", "--out",
                 (simulator.folder() / "x").string(), "--runs", "1", "--no-extras", "--unit", "mm"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(
      outcome.err,
      testing::EndsWith("put the robot on its start mark and press Enter \nastrolabe: the input ended "
                        "where an answer was expected: answer at a terminal, or pipe all answers in\n"));
  EXPECT_EQ(outcome.err.find("next is"), outcome.err.rfind("next is"));
}

TEST(Umbmark, KeepsADriveWhoseTruthCannotBeReadAndGoesOnWithItOnceItCan) {
  const Simulator simulator;
  const fs::path out = simulator.folder() / "x", csv = out / "truth" / "before-square-cw-1.csv";
  const fs::path driven = out / "before" / "square-cw-1.mcap.no-truth";
  fs::create_directories(csv.parent_path());
  const auto umbmark_with = [&](const std::string& truth) {
    std::ofstream(csv) << truth;
    // It counts as that of the run, which begins only after the robot has answered.
    fs::last_write_time(csv, fs::file_time_type::clock::now() + std::chrono::hours(1));
    return astrolabe({"umbmark", "--port", simulator.port(), "--truth", "file", "--out", out.string(),
                      "--side", "0.5", "--runs", "1", "--no-extras"});
  };
  const support::Outcome bad = umbmark_with("x_m,y_m\n0,0\n0.0l,0\n");
  EXPECT_EQ(bad.code, 1);
  EXPECT_THAT(bad.err, testing::AllOf(HasSubstr(csv.string()), HasSubstr("line 3"), HasSubstr("'0.0l'"),
                                      HasSubstr("the drive is kept")));
  EXPECT_TRUE(fs::exists(driven));

  const support::Outcome good = umbmark_with("x_m,y_m\n0,0\n0.01,0\n");
  EXPECT_THAT(good.err,
              testing::AllOf(HasSubstr("square cw 1 is driven"), HasSubstr("recorded before: square cw 1"),
                             HasSubstr("before-square-ccw-1.csv")));
  EXPECT_TRUE(fs::exists(out / "before" / "square-cw-1.mcap"));
  EXPECT_FALSE(fs::exists(driven));
}

TEST(Umbmark, DoesNotTakeTheTruthOfAnEarlierExperimentForThatOfTheRunJustDriven) {
  const Simulator simulator;
  const fs::path out = simulator.folder() / "x", csv = out / "truth" / "before-square-cw-1.csv";
  fs::create_directories(csv.parent_path());
  std::ofstream(csv) << "x_m,y_m\n0,0\n0.01,0\n";
  fs::last_write_time(csv, fs::file_time_type::clock::now() - std::chrono::hours(72));
  const support::Outcome outcome =
      astrolabe({"umbmark", "--port", simulator.port(), "--truth", "file", "--out", out.string(), "--side",
                 "0.5", "--runs", "1", "--no-extras", "--yes"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err,
              testing::AllOf(HasSubstr(csv.string()), HasSubstr("before this run began"),
                             HasSubstr("press Enter once it is there"), HasSubstr("the drive is kept")));
  EXPECT_FALSE(fs::exists(out / "before" / "square-cw-1.mcap"));
}

TEST(Umbmark, HelpShowsTheFormatOfTruthFiles) {
  EXPECT_THAT(astrolabe({"umbmark", "--help"}).out,
              testing::AllOf(HasSubstr("before-square-cw-1.csv"), HasSubstr("x_m,y_m,theta_deg")));
}

}  // namespace
}  // namespace astro
