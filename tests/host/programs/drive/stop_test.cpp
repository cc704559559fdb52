#include <gmock/gmock.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <utility>

#include "tests/support/links/fake_robot.hpp"
#include "tests/support/links/pty.hpp"
#include "tests/support/robots/watched_drive.hpp"

// Drives that are cut short, against a simulator in real time; the virtual cameras show what the robot really
// does. All bounds are on the robot's clock, so a busy machine does not move them.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::kToRest_s;
using support::Outcome;
using support::Program;
using testing::HasSubstr;

constexpr std::int64_t kTimeout_us = std::chrono::microseconds(support::kTimeout).count();

class CutShort : public support::WatchedDrive {
 protected:
  using support::WatchedDrive::WatchedDrive;
};

/// What a robot at a pty is sent, without its questions about the status, which another program might hold up.
void answer_all_but_the_status(test::Pty& pty, test::FakeRobot& robot, Program& program) {
  test::FakeRobot::Bytes frame;
  protocol::Framer framer;
  while (program.running()) {
    pollfd ready{pty.master(), POLLIN, 0};
    std::array<std::uint8_t, 256> bytes{};
    const ssize_t count = ::poll(&ready, 1, 10) > 0 ? ::read(pty.master(), bytes.data(), bytes.size()) : 0;
    for (ssize_t i = 0; i < count; ++i) {
      const std::uint8_t byte = bytes.at(static_cast<std::size_t>(i));
      frame.push_back(byte);
      const auto body = framer.push(byte);
      if (byte != 0) continue;  // the end of a frame
      const auto whole = std::exchange(frame, {});
      if (body && body->front() == protocol::GetStatus::kId) continue;
      for (const auto& answer : robot.receive(whole))
        EXPECT_EQ(::write(pty.master(), answer.data(), answer.size()), static_cast<ssize_t>(answer.size()));
    }
  }
}

TEST(EmergencyStop, OfTheCommandLineAsksTheRobotNothingBefore) {
  test::Pty pty;
  test::FakeRobot robot;
  Program stop({ASTROLABE_PROGRAM, "stop", "--emergency", "--port", pty.path()});
  answer_all_but_the_status(pty, robot, stop);
  EXPECT_EQ(robot.executed[protocol::EmergencyStop::kId], 1) << stop.err();  // this robot then refuses it
}

TEST_F(CutShort, KilledDuringAPathTheRobotStopsByItselfAndDrivesAgain) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  program.send(SIGKILL);
  EXPECT_LT(seconds_to_rest(now_us()), kToRest_s);

  const json after = info();
  EXPECT_EQ(after["mode"], "fault");
  EXPECT_EQ(after["faults"], json::array({"link_lost"}));

  const Outcome again = astrolabe({"drive", "line", "0.2", "--json", "--port", simulator_.port()});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("link_lost")) << "says that it cleared it";
  EXPECT_NEAR(support::parse_json(again.out)["moved"]["x_m"], 0.2, 0.002);
}

TEST_F(CutShort, KilledWhileHoldingAVelocityTheRobotStopsByItsCommandTimeOut) {
  Program program = drive({"velocity", "0.4", "0", "--for", "60"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  program.send(SIGKILL);
  EXPECT_LT(seconds_to_rest(now_us()), kToRest_s);
  EXPECT_EQ(info()["faults"], json::array({"command_timeout"}));
}

TEST_F(CutShort, AHostThatIsHeldUpLosesItsRobotUnlessTheTimeOutIsLonger) {
  for (const bool forgiving : {false, true}) {
    if (forgiving) support::forgive_late_hosts(simulator_);
    Program program = drive({"line", "3", "--speed", "0.4"});
    ASSERT_TRUE(has_gone(0.2)) << program.err();
    program.send(SIGSTOP);
    const std::int64_t held_us = now_us();
    EXPECT_TRUE(support::eventually([&] { return now_us() > held_us + 2 * kTimeout_us; }));
    program.send(SIGCONT);
    EXPECT_EQ(program.wait(), forgiving ? 0 : 1) << program.err();
    EXPECT_EQ(info()["faults"], forgiving ? json::array() : json::array({"link_lost"}));
  }
}

TEST_F(CutShort, InterruptedTheRobotRampsToRestAndIsDisarmed) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program = drive({"line", "20", "--speed", "0.4", "--json"});
    ASSERT_TRUE(has_gone(0.3)) << program.err();
    program.send(signal);
    EXPECT_EQ(program.wait(), 130);
    EXPECT_EQ(program.err(), "astrolabe: stopped: the robot is at rest and disarmed\n");
    const json report = support::parse_json(program.out());
    EXPECT_EQ(report["outcome"], "interrupted");
    EXPECT_GT(report["moved"]["x_m"], 0.2);
    EXPECT_LT(seconds_to_rest(now_us()), 0.1);  // it was at rest when the program ended
    EXPECT_EQ(info()["mode"], "disarmed");
    EXPECT_EQ(info()["faults"], json::array());
  }
}

TEST_F(CutShort, TheSecondInterruptEndsTheProgramAtOnceAndTheRobotStopsByItself) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  simulator_.program().send(SIGSTOP);  // so that the first signal finds the program waiting
  // Whatever comes within 0.3 s after the first one belongs to it, so a person presses Ctrl-C again and again.
  EXPECT_TRUE(support::eventually([&] {
    program.send(SIGINT);
    poll(nullptr, 0, 50);
    return !program.running();
  }));
  EXPECT_EQ(program.wait(), 130);
  EXPECT_EQ(program.err(), "");
  simulator_.program().send(SIGCONT);
  EXPECT_LT(seconds_to_rest(now_us()), kToRest_s);
}

TEST_F(CutShort, WhoeverEndsItWithSeveralSignalsAtOnceMeansOneInterrupt) {
  for (const int second : {SIGINT, SIGTERM, SIGHUP}) {
    Program program = drive({"line", "20", "--speed", "0.4"});
    ASSERT_TRUE(has_gone(0.3)) << program.err();
    program.send(SIGSTOP);  // so that both wait when it continues
    program.send(SIGTERM);
    program.send(second);
    program.send(SIGCONT);
    EXPECT_EQ(program.wait(), 130);
    EXPECT_EQ(program.err(), "astrolabe: stopped: the robot is at rest and disarmed\n");
    EXPECT_EQ(info()["mode"], "disarmed");
  }
}

TEST_F(CutShort, StopDoesNotCallARobotAtRestThatAFaultLetsRollOn) {
  Program program = drive({"velocity", "0.7", "0", "--for", "60"});
  ASSERT_TRUE(has_gone(0.5)) << program.err();
  ASSERT_EQ(astrolabe({"stop", "--emergency", "--port", simulator_.port()}).code, 0);
  const Outcome stop = astrolabe({"stop", "--port", simulator_.port()});
  EXPECT_THAT(stop.err, HasSubstr("emergency_stop"));
  EXPECT_THAT(stop.err, testing::Not(HasSubstr("the robot is at rest and disarmed")));
  if (stop.code == 0) {
    EXPECT_THAT(stop.err, HasSubstr("the robot has stopped"));
    EXPECT_LT(seconds_to_rest(now_us()), 0.1);
  }
  program.wait();
}

TEST_F(CutShort, ADriveThatCanNoLongerBeRecordedRampsToRestAndSaysWhy) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path() / "run.mcap";
  Program program({"/bin/sh", "-c", "ulimit -f 16; exec \"$0\" \"$@\"", ASTROLABE_PROGRAM, "drive",
                   "velocity", "0.7", "0", "--for", "60", "--record", file, "--port", simulator_.port()});
  EXPECT_EQ(program.wait(), 1);
  EXPECT_LT(seconds_to_rest(now_us()), 0.1) << "it stood when the program ended";
  EXPECT_EQ(info()["mode"], "disarmed");
  EXPECT_EQ(info()["faults"], json::array());
  EXPECT_THAT(program.err(), HasSubstr("could not be recorded; the robot is at rest and disarmed"));
  EXPECT_THAT(program.err(), testing::Not(HasSubstr("did not confirm")));
  const std::string text = program.err();
  const std::size_t once = text.find("cannot write");
  EXPECT_NE(once, std::string::npos) << text;
  EXPECT_EQ(text.find("cannot write", once + 1), std::string::npos) << "told once: " << text;
}

TEST_F(CutShort, PauseAndResumeOfARobotThatNobodyDrivesSaySo) {
  for (const char* const word : {"pause", "resume"}) {
    const Outcome outcome = astrolabe({word, "--port", simulator_.port()});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr(std::string("there is nothing to ") + word));
  }
}

TEST_F(CutShort, ClosedStandardStreamsAreNotTheRobotsLine) {
  const auto bad_frames = [&] { return info()["rx_bad_frames"].get<int>(); };
  const int before = bad_frames();
  for (const char* const closed : {">&-", "2>&-", "<&-", "<&- >&- 2>&-"}) {
    Program program({"/bin/sh", "-c", std::string("exec \"$0\" info --json --port \"$1\" ") + closed,
                     ASTROLABE_PROGRAM, simulator_.port()});
    const bool can_print = std::string(closed) == "2>&-" || std::string(closed) == "<&-";
    EXPECT_EQ(program.wait(), can_print ? 0 : 1) << closed;
  }
  EXPECT_EQ(bad_frames(), before);
}

TEST_F(CutShort, InterruptedWhileTheRobotDoesNotAnswerItIsNotCalledStopped) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.1)) << program.err();
  simulator_.program().send(SIGSTOP);
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), HasSubstr("did not confirm that it stopped"));
  EXPECT_THAT(program.err(), testing::Not(HasSubstr("at rest")));
}

TEST_F(CutShort, InterruptedOnceTheLinkIsLostTheDriveSaysThatItIsLost) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.1)) << program.err();
  program.send(SIGSTOP);  // so that it receives both when it continues
  simulator_.program().send(SIGKILL);
  simulator_.program().wait();
  program.send(SIGINT);
  program.send(SIGCONT);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), HasSubstr("lost " + simulator_.port()));
}

TEST_F(CutShort, WhenTheSimulatorEndsTheDriveSaysSo) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.1)) << program.err();
  simulator_.program().send(SIGKILL);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), HasSubstr("lost " + simulator_.port()));
}

struct FolderOfFlash {
  test::TemporaryFolder folder;
};

class WithFlash : public FolderOfFlash, public CutShort {
 protected:
  WithFlash() : CutShort({"--flash", (folder.path() / "flash").string()}) {}
};

// The robot writes its fault into its flash when it is at rest. The content of the flash must be on the disk
// before any host learns of it, so a simulator that cannot write it does not continue.
TEST_F(WithFlash, ASimulatorThatCannotKeepWhatItsRobotHasWrittenEndsAndSaysSo) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  std::filesystem::remove_all(folder.path());
  std::ofstream(folder.path()) << "no folder any more, and none can be made here\n";
  program.send(SIGKILL);
  EXPECT_EQ(simulator_.program().wait(), 1);
  EXPECT_THAT(simulator_.program().err(), HasSubstr("cannot make the folder " + folder.path().string()));
}

}  // namespace
}  // namespace astro
