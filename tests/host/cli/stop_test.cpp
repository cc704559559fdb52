#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "host/truth/socket_source.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"

// Drives that are cut short, against a simulator in real time; the virtual cameras say what the robot really
// does. All bounds are on the robot's clock, so a busy machine does not move them.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::eventually;
using support::Outcome;
using support::Program;
using testing::HasSubstr;

class CutShort : public testing::Test {
 protected:
  explicit CutShort(const std::vector<std::string>& options = {}) : simulator_(options) {}

  Program drive(const std::vector<std::string>& what) const {
    std::vector<std::string> words{ASTROLABE_PROGRAM, "drive"};
    words.insert(words.end(), what.begin(), what.end());
    words.insert(words.end(), {"--port", simulator_.port()});
    return Program(words);
  }

  /// Waits until the robot has gone this far from where it is now.
  bool has_gone(double metres) {
    track_.clear();
    return eventually([&] {
      look();
      return !track_.empty() && distance(track_.front(), track_.back()) > metres;
    });
  }

  /// Waits until the robot has stood still for 0.3 s; returns for how long it moved after `from_us`.
  double seconds_to_rest(std::int64_t from_us) {
    std::int64_t rest_us = -1;
    EXPECT_TRUE(eventually([&] { return (look(), rest_us = standing_since()) >= 0; }));
    const double seconds = static_cast<double>(rest_us - from_us) / 1e6;
    RecordProperty("seconds_to_rest", std::to_string(seconds));
    return seconds;
  }

  std::int64_t now_us() {
    look();
    return track_.back().time_us;
  }

  json info() const {
    return support::parse_json(astrolabe({"info", "--json", "--port", simulator_.port()}).out);
  }

  support::Simulator simulator_;

 private:
  void look() {
    for (const auto& sample : cameras_.poll()) track_.push_back(sample);
  }
  static double distance(const recording::TruthSample& a, const recording::TruthSample& b) {
    return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
  }
  // Cameras have 0.2 mm of noise: 2 mm within 0.3 s is 7 mm/s and ten times the noise.
  std::int64_t standing_since() const {
    constexpr std::int64_t kLongEnough_us = 300'000;
    constexpr double kStill_m = 0.002;
    if (track_.empty()) return -1;
    auto first = track_.rbegin();
    while (first != track_.rend() && distance(*first, track_.back()) < kStill_m) ++first;
    const std::int64_t since_us = first == track_.rend() ? track_.front().time_us : first->time_us;
    return track_.back().time_us - since_us >= kLongEnough_us ? since_us : -1;
  }

  truth::SocketSource cameras_{truth::mocap_socket_of(simulator_.port())};
  std::vector<recording::TruthSample> track_;
};

// The command time-out is 200 ms; then the robot ramps from 0.4 m/s to rest at 0.5 m/s^2: 1 s. A camera
// period and what the simulator was behind when the program was killed come on top.
constexpr double kToRest_s = 1.2;

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
    EXPECT_LT(seconds_to_rest(now_us()), 0.1);  // it stood when the program ended
    EXPECT_EQ(info()["mode"], "disarmed");
    EXPECT_EQ(info()["faults"], json::array());
  }
}

TEST_F(CutShort, TheSecondInterruptEndsTheProgramAtOnceAndTheRobotStopsByItself) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  program.send(SIGSTOP);  // so that both are waiting when it goes on
  program.send(SIGINT);
  program.send(SIGTERM);
  program.send(SIGCONT);
  EXPECT_EQ(program.wait(), 130);
  EXPECT_LT(seconds_to_rest(now_us()), kToRest_s);
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
  program.send(SIGSTOP);  // so that it finds both when it goes on
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

TEST_F(WithFlash, InterruptedTheSimulatorSaysThatItsLastFaultCouldNotBeSaved) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.3)) << program.err();
  program.send(SIGKILL);
  std::filesystem::remove_all(folder.path());
  seconds_to_rest(now_us());  // a fault stops the robot, which writes it into its flash once it stands
  poll(nullptr, 0, 500);      // on the robot's clock, and nobody may ask it
  simulator_.program().send(SIGINT);
  EXPECT_EQ(simulator_.program().wait(), 1);
  EXPECT_THAT(simulator_.program().err(), HasSubstr("flash cannot be written"));
}

TEST_F(CutShort, WhileOneProgramDrivesAnotherFindsThePortInUse) {
  Program program = drive({"line", "20", "--speed", "0.4"});
  ASSERT_TRUE(has_gone(0.1)) << program.err();
  for (const char* command : {"info", "monitor", "stop"}) {
    const Outcome outcome = astrolabe({command, "--port", simulator_.port()});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("in use by another program")) << command;
  }
  EXPECT_TRUE(program.running()) << "the drive is not disturbed";
}

}  // namespace
}  // namespace astro
