#include <gmock/gmock.h>

#include <algorithm>

#include "host/recording/run_file.hpp"
#include "tests/support/robots/watched_drive.hpp"

// Several programs at one port, as people run them. Bounds on the robot's motion are on its own clock.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::eventually;
using support::kToRest_s;
using support::Outcome;
using support::Program;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class OnePort : public support::WatchedDrive {
 protected:
  std::vector<std::string> at_port(std::vector<std::string> words) const {
    words.insert(words.end(), {"--port", simulator_.port()});
    return words;
  }
  Outcome run(const std::vector<std::string>& words) const { return astrolabe(at_port(words)); }
  Program start(const std::vector<std::string>& words) const {
    std::vector<std::string> command{ASTROLABE_PROGRAM};
    const auto all = at_port(words);
    command.insert(command.end(), all.begin(), all.end());
    return Program(command);
  }
  static std::string process(const Program& program) {
    return "process id " + std::to_string(program.pid()) + ", 'astrolabe ";
  }
  /// A monitor that opens the port before any other program.
  static bool shows_samples(const Program& monitor) {
    return eventually([&] { return monitor.out().find('\n') != std::string::npos; });
  }
};

TEST_F(OnePort, AnEmergencyStopWorksBesideADrive) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  Program stop = start({"stop", "--emergency"});
  const std::string who = process(stop) + "stop --emergency";
  EXPECT_EQ(stop.wait(), 0) << stop.err();
  EXPECT_LT(seconds_to_rest(now_us()), 1.2);  // motors off: friction alone brings it to rest
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), AllOf(HasSubstr("emergency_stop"), HasSubstr(who)));
  EXPECT_EQ(info()["faults"], json::array({"emergency_stop"}));
}

TEST_F(OnePort, AStopWorksBesideADriveAndTheDriveSaysWhoStoppedIt) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  Program stop = start({"stop"});
  const std::string who = "another program (" + process(stop) + "stop";
  EXPECT_EQ(stop.wait(), 0) << stop.err();
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), AllOf(HasSubstr(who), HasSubstr("stopped the robot")));
  EXPECT_EQ(info()["mode"], "disarmed");
  EXPECT_EQ(info()["faults"], json::array());
}

TEST_F(OnePort, AStopHoldsAgainstAProgramThatRepeatsItsVelocity) {
  Program program = drive({"velocity", "0.4", "0", "--for", "60"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  const Outcome stop = run({"stop"});
  EXPECT_EQ(stop.code, 0) << stop.err;
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), HasSubstr("stopped the robot"));
  EXPECT_LT(seconds_to_rest(now_us()), 0.1);
}

TEST_F(OnePort, EverythingThatOnlyLooksWorksBesideADrive) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.1)) << program.err();
  EXPECT_EQ(info()["mode"], "segment");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"faults"}, {"params", "get", "b"}, {"params", "list"}, {"monitor", "--count", "3"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << words.front() << ": " << outcome.err;
  }
  EXPECT_THAT(run({"resume"}).err, HasSubstr("was not paused"));
  EXPECT_EQ(run({"pause"}).code, 0);
  EXPECT_TRUE(eventually([&] { return info()["mode"] == "paused"; }));
  EXPECT_THAT(run({"resume"}).err, HasSubstr("the robot goes on"));
  EXPECT_TRUE(has_gone(0.1));
  EXPECT_TRUE(program.running()) << program.err();
}

TEST_F(OnePort, AMonitorAndARecordingRunBesideADriveToItsEnd) {
  const auto file = (simulator_.folder() / "beside.mcap").string();
  Program monitor = start({"monitor", "--json", "--rate", "50"});
  ASSERT_TRUE(shows_samples(monitor));
  Program record = start({"record", "--out", file});
  ASSERT_TRUE(eventually([&] { return record.err().find("recording") != std::string::npos; }));
  Program program = drive({"line", "0.6", "--speed", "0.3", "--json"});
  EXPECT_EQ(program.wait(), 0) << program.err();
  EXPECT_NEAR(support::parse_json(program.out())["moved"]["x_m"], 0.6, 0.005);
  record.send(SIGINT);
  EXPECT_EQ(record.wait(), 0) << record.err();
  monitor.send(SIGINT);
  EXPECT_EQ(monitor.wait(), 0) << monitor.err();
  const recording::Run run = recording::read_run(file);
  ASSERT_GT(run.odometry.size(), 100U);
  for (std::size_t i = 1; i < run.odometry.size(); ++i)
    ASSERT_LE(run.odometry[i].time_us - run.odometry[i - 1].time_us, 100'000) << "a hole at " << i;
  EXPECT_NEAR(run.odometry.back().x_m, support::parse_json(program.out())["odometry"]["x_m"], 0.001);
}

TEST_F(OnePort, TheEndOfAProgramThatServedADriveDoesNotDisturbIt) {
  Program monitor = start({"monitor", "--json"});
  ASSERT_TRUE(shows_samples(monitor));
  Program program =
      drive({"line", "3", "--speed", "0.4", "--json"});  // so that it lasts until it was looked at
  ASSERT_TRUE(has_gone(0.1)) << program.err();
  monitor.send(SIGINT);
  EXPECT_EQ(monitor.wait(), 0);
  EXPECT_TRUE(program.running());
  EXPECT_EQ(info()["mode"], "segment") << "and others find the port served";
  EXPECT_EQ(program.wait(), 0) << program.err();
  EXPECT_NEAR(support::parse_json(program.out())["moved"]["x_m"], 3, 0.015);
  EXPECT_EQ(run({"info"}).code, 0) << "the port is free again";
}

TEST_F(OnePort, ASecondDriveIsRefusedWithASentenceThatNamesTheFirst) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.1)) << program.err();
  const Outcome second = run({"drive", "spin", "90"});
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.err, HasSubstr("is driving for another program (" + process(program) + "drive line 20"));
  EXPECT_TRUE(has_gone(0.1)) << "the first drives on";
}

TEST_F(OnePort, KilledTheFirstProgramLeavesAStandingRobotAndASentence) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.2)) << program.err();
  Program monitor = start({"monitor", "--json"});
  ASSERT_TRUE(shows_samples(monitor));
  const std::string who = process(program);
  program.send(SIGKILL);
  EXPECT_LT(seconds_to_rest(now_us()), kToRest_s);
  EXPECT_EQ(monitor.wait(), 1);
  EXPECT_THAT(monitor.err(),
              AllOf(HasSubstr("the program that held the port (" + who), HasSubstr("has ended")));
  const std::string said = monitor.err();
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_EQ(info()["faults"], json::array({"link_lost"})) << "the port is free";
}

TEST_F(OnePort, KilledTheProgramThatServedItADriveEndsWithASentenceAndTheRobotStops) {
  Program monitor = start({"monitor", "--json"});
  ASSERT_TRUE(shows_samples(monitor));
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.2)) << program.err();
  const std::string who = process(monitor);
  monitor.send(SIGKILL);
  EXPECT_LT(seconds_to_rest(now_us()), kToRest_s);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(),
              AllOf(HasSubstr("the program that held the port (" + who), HasSubstr("has ended")));
}

TEST_F(OnePort, StoppedTheFirstProgramIsNamedTheRobotStopsAndItsFaultIsTold) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.2)) << program.err();
  program.send(SIGSTOP);
  EXPECT_LT(seconds_to_rest(now_us()), kToRest_s);
  const auto start_time = std::chrono::steady_clock::now();
  const Outcome outcome = run({"stop", "--emergency"});
  EXPECT_LT(std::chrono::steady_clock::now() - start_time, std::chrono::seconds(20));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("the program with " + process(program)),
                                 HasSubstr("holds the port and does not answer")));
  program.send(SIGCONT);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), AllOf(HasSubstr("link_lost"), Not(HasSubstr("another program"))));
}

TEST_F(OnePort, AMonitorThatReadsNothingSlowsNobody) {
  Program monitor = start({"monitor", "--json", "--rate", "200"});
  ASSERT_TRUE(shows_samples(monitor));
  Program program = drive({"line", "1.2", "--speed", "0.4", "--json"});
  ASSERT_TRUE(has_gone(0.1)) << program.err();
  Program stuck = start({"monitor", "--json", "--rate", "200"});
  ASSERT_TRUE(shows_samples(stuck));
  stuck.send(SIGSTOP);
  EXPECT_EQ(program.wait(), 0) << program.err();
  EXPECT_NEAR(support::parse_json(program.out())["moved"]["x_m"], 1.2, 0.005);
  EXPECT_EQ(info()["faults"], json::array()) << "no command was late";
}

TEST_F(OnePort, ADriveRecordsItself) {
  const auto file = (simulator_.folder() / "drive.mcap").string();
  Program program = drive({"line", "0.5", "--speed", "0.3", "--record", file});
  EXPECT_EQ(program.wait(), 0) << program.err();
  const recording::Run run = recording::read_run(file);
  EXPECT_FALSE(run.warning);
  EXPECT_NEAR(run.odometry.back().x_m - run.odometry.front().x_m, 0.5, 0.005);
  EXPECT_NE(run.odometry.back().left_counts, run.odometry.front().left_counts);
  EXPECT_GT(run.info.parameters.at("b"), 0.1);
  const Outcome again = astrolabe(at_port({"drive", "line", "0.5", "--record", file}));
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, HasSubstr("'" + file + "' exists, and a recording replaces nothing"));
}

TEST_F(OnePort, ARecordedDriveThatIsInterruptedKeepsWhatItRecorded) {
  const auto file = (simulator_.folder() / "drive.mcap").string();
  Program program = drive({"line", "20", "--speed", "0.4", "--record", file});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), 130);
  const recording::Run run = recording::read_run(file);
  EXPECT_FALSE(run.warning);
  EXPECT_GT(run.odometry.back().x_m - run.odometry.front().x_m, 0.2);
}

// The robot distinguishes onlookers from its driver: the pings of a monitor do not keep the drive of a killed
// program alive.
TEST_F(OnePort, KilledBesideAMonitorThatServesItADriveIsStoppedByTheMonitor) {
  Program monitor = start({"monitor", "--json"});
  ASSERT_TRUE(shows_samples(monitor));
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  program.send(SIGKILL);
  EXPECT_LT(seconds_to_rest(now_us()), kToRest_s);
  EXPECT_TRUE(monitor.running());
}

TEST_F(OnePort, StoppedBesideAMonitorThatServesItADriveEndsByTheRobotsTimeOut) {
  Program monitor = start({"monitor", "--json"});
  ASSERT_TRUE(shows_samples(monitor));
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  program.send(SIGSTOP);
  EXPECT_LT(seconds_to_rest(now_us()), kToRest_s);
  program.send(SIGCONT);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), AllOf(HasSubstr("link_lost"), Not(HasSubstr("another program"))));
}

}  // namespace
}  // namespace astro
