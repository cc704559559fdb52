#include <gmock/gmock.h>

#include "tests/support/base/columns.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/programs/terminal_program.hpp"

// What a person sees in a terminal, and that a pipe gets none of it.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::Outcome;
using support::TerminalProgram;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

constexpr const char* kUp = "\033[A";
constexpr const char* kCtrlC = "\003";

class Terminal : public testing::Test {
 protected:
  Words command(Words words) const {
    words.insert(words.begin(), ASTROLABE_PROGRAM);
    words.insert(words.end(), {"--port", simulator_.port()});
    return words;
  }
  json info() const {
    return support::parse_json(astrolabe({"info", "--json", "--port", simulator_.port()}).out);
  }

  support::Simulator simulator_{{}};  // in real time, as people do
};

TEST_F(Terminal, TeleopDrivesByKeysAndLeavesTheTerminalAsItWas) {
  TerminalProgram teleop(command({"drive", "teleop"}));
  ASSERT_TRUE(teleop.shows("space   stop")) << teleop.seen();
  EXPECT_FALSE(teleop.is_cooked());
  teleop.type(kUp);
  teleop.type("w");
  ASSERT_TRUE(teleop.shows("+0.16 m/s    is +0.1")) << teleop.seen();  // two fifths of 0.4, and it moves
  teleop.type(" ");
  ASSERT_TRUE(teleop.shows("+0.00 m/s")) << teleop.seen();
  teleop.type("q");
  EXPECT_EQ(teleop.wait(), 0);
  EXPECT_THAT(teleop.seen(), HasSubstr("odometry  x"));
  EXPECT_TRUE(teleop.is_cooked());
  EXPECT_EQ(info()["mode"], "disarmed");
}

TEST_F(Terminal, TeleopDrivesByNoKeyThatWasPressedBeforeItBegan) {
  TerminalProgram teleop(command({"drive", "teleop"}), {.typed_ahead = "w"});
  ASSERT_TRUE(teleop.shows("space   stop")) << teleop.seen();
  ASSERT_TRUE(teleop.shows("+0.00 m/s")) << teleop.seen();
  teleop.type("q");
  EXPECT_EQ(teleop.wait(), 0);
  EXPECT_THAT(teleop.seen(), Not(HasSubstr("+0.08 m/s")));
}

TEST_F(Terminal, TeleopEndsOnCtrlCWithTheRobotAtRestAndTheTerminalAsItWas) {
  TerminalProgram teleop(command({"drive", "teleop"}));
  ASSERT_TRUE(teleop.shows("space   stop")) << teleop.seen();
  teleop.type(kUp);
  ASSERT_TRUE(teleop.shows("+0.08 m/s    is +0.0")) << teleop.seen();
  teleop.type(kCtrlC);
  EXPECT_EQ(teleop.wait(), 130);
  EXPECT_TRUE(teleop.is_cooked());
  EXPECT_EQ(info()["mode"], "disarmed");
}

TEST_F(Terminal, TeleopPutsTheTerminalBackWhenTheRobotGoesAway) {
  TerminalProgram teleop(command({"drive", "teleop"}));
  ASSERT_TRUE(teleop.shows("turn left")) << teleop.seen();
  simulator_.program().send(SIGKILL);
  EXPECT_EQ(teleop.wait(), 1);
  EXPECT_TRUE(teleop.is_cooked());
}

TEST_F(Terminal, TeleopPutsTheTerminalBackWhenItIsEndedByForce) {
  TerminalProgram teleop(command({"drive", "teleop"}));
  ASSERT_TRUE(teleop.shows("turn left")) << teleop.seen();
  teleop.send(SIGSTOP);
  teleop.send(SIGINT);
  teleop.send(SIGTERM);
  teleop.send(SIGCONT);
  EXPECT_EQ(teleop.wait(), 130);
  EXPECT_TRUE(teleop.is_cooked());
}

TEST_F(Terminal, TeleopWithoutATerminalSaysWhatToDo) {
  const Outcome outcome = astrolabe({"drive", "teleop", "--port", simulator_.port()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("terminal"));
}

TEST_F(Terminal, TeleopShowsAllOfItAt40Columns) {
  TerminalProgram teleop(command({"drive", "teleop"}), {40, 24, "xterm"});
  for (const char* const line : {"space    stop", "turning   +0.00 rad/s  is +0.000", "heading 0.0 deg"})
    ASSERT_TRUE(teleop.shows(line)) << teleop.seen();
  teleop.type("q");
  EXPECT_EQ(teleop.wait(), 0);
}

TEST_F(Terminal, ADumbTerminalGetsLinesAndNoEscapeSequence) {
  const support::TerminalKind dumb{80, 24, "dumb"};
  TerminalProgram teleop(command({"drive", "teleop"}), dumb);
  ASSERT_TRUE(teleop.shows("W faster")) << teleop.seen();
  teleop.type("w");
  ASSERT_TRUE(teleop.shows("+0.08 m/s  +0.00 rad/s  x   0.0")) << teleop.seen();
  teleop.type("q");
  EXPECT_EQ(teleop.wait(), 0);
  EXPECT_THAT(teleop.seen(), Not(HasSubstr("\033")));

  TerminalProgram monitor(command({"monitor"}), dumb);
  ASSERT_TRUE(monitor.shows(" V  x ")) << monitor.seen();
  monitor.type("q");
  EXPECT_EQ(monitor.wait(), 0);
  EXPECT_THAT(monitor.seen(), Not(HasSubstr("\033")));

  TerminalProgram drive(command({"drive", "line", "0.5", "--speed", "0.2"}), dumb);
  EXPECT_EQ(drive.wait(), 0);
  EXPECT_THAT(drive.seen(), Not(HasSubstr("\033")));

  TerminalProgram mistake({ASTROLABE_PROGRAM, "upload", "/no/such/file"}, dumb);
  EXPECT_EQ(mistake.wait(), 1);
  EXPECT_THAT(mistake.seen(), testing::AllOf(HasSubstr("astrolabe: "), Not(HasSubstr("\033"))));
}

TEST_F(Terminal, MonitorIsAPictureInPlaceUntilQ) {
  TerminalProgram monitor(command({"monitor"}));
  ASSERT_TRUE(monitor.shows("battery   1")) << monitor.seen();
  ASSERT_TRUE(monitor.shows("\033[18F")) << "it is drawn over, not below";
  monitor.type("q");
  EXPECT_EQ(monitor.wait(), 0);
  EXPECT_TRUE(monitor.is_cooked());
}

TEST_F(Terminal, MonitorFindsARobotAgainThatRestarts) {
  TerminalProgram monitor(command({"monitor"}));
  ASSERT_TRUE(monitor.shows("battery   1")) << monitor.seen();
  simulator_.program().send(SIGTERM);
  ASSERT_TRUE(monitor.shows("LOST")) << monitor.seen();
  support::Program again({ASTROLABE_PROGRAM, "sim", "--pty", simulator_.port()});
  EXPECT_TRUE(monitor.shows("round trip")) << monitor.seen();
  monitor.type("q");
  EXPECT_EQ(monitor.wait(), 0);
}

TEST_F(Terminal, DriveShowsABarOnceASecondHasPassed) {
  TerminalProgram drive(command({"drive", "line", "0.5", "--speed", "0.2"}));
  EXPECT_EQ(drive.wait(), 0);
  EXPECT_THAT(drive.seen(), HasSubstr("driving ██"));
  EXPECT_THAT(drive.seen(), HasSubstr("\r\033[Kmoved     x")) << "the bar makes room for what is said";
}

TEST_F(Terminal, ARecordedRunMovesItsBarWhileItIsDriven) {
  const test::TemporaryFolder folder;
  TerminalProgram record(command({"record", "--lines", "1", "--length", "0.5", "--speed", "0.2", "--out",
                                  (folder.path() / "runs").string()}));
  EXPECT_EQ(record.wait(), 0);
  EXPECT_THAT(record.seen(), HasSubstr("driving ██████")) << "a line is one segment, and 2.9 s long";
}

TEST_F(Terminal, WorkWithoutAKnownEndShowsNoBar) {
  const test::TemporaryFolder folder;
  TerminalProgram record(command({"record", "--out", (folder.path() / "run.mcap").string()}));
  ASSERT_TRUE(record.shows("recording  1 s")) << record.seen();
  record.type(kCtrlC);
  EXPECT_EQ(record.wait(), 0);
  EXPECT_THAT(record.seen(), testing::Not(HasSubstr("░")));
}

TEST_F(Terminal, ABarMakesRoomForAQuestion) {
  const support::Simulator fast;
  TerminalProgram umbmark({ASTROLABE_PROGRAM, "umbmark", "--truth", "manual", "--side", "0.5", "--runs", "1",
                           "--no-extras", "--unit", "mm", "--port", fast.port(), "--out",
                           (fast.folder() / "x").string()});
  ASSERT_TRUE(umbmark.shows("press Enter")) << umbmark.seen();
  poll(nullptr, 0, 1200);  // a bar appears only after a second
  umbmark.type("\n");
  ASSERT_TRUE(umbmark.shows("x, forward of the start mark")) << umbmark.seen();
  EXPECT_THAT(umbmark.seen(), HasSubstr("\r\033[Krun square cw 1"));
  umbmark.type(kCtrlC);
  EXPECT_EQ(umbmark.wait(), 130);
}

TEST_F(Terminal, OfAPipeSeesNoEscapeCodesAndNoBar) {
  for (const Words& words : {Words{"info"}, Words{"ports"}, Words{"params", "list"},
                             Words{"params", "get", "b"}, Words{"faults"}, Words{"monitor", "--count", "3"},
                             Words{"drive", "line", "0.3"}, Words{"stop"}, Words{"drive", "teleop"}}) {
    Words all = words;
    if (words[0] != "ports") all.insert(all.end(), {"--port", simulator_.port()});
    const Outcome outcome = astrolabe(all);
    EXPECT_THAT(outcome.out + outcome.err, Not(HasSubstr("\033"))) << words[0];
    EXPECT_THAT(outcome.out + outcome.err, Not(HasSubstr("\r"))) << words[0];
  }
}

TEST_F(Terminal, ParameterListIsCutToItsWidth) {
  TerminalProgram list(command({"params", "list"}));
  EXPECT_EQ(list.wait(), 0);
  EXPECT_LE(support::widest_line(list.seen()), 81U);  // a carriage return is not visible
}

TEST_F(Terminal, NoAnswerThatWasTypedBeforeItsQuestionWritesTheFlash) {
  TerminalProgram set(command({"params", "set", "c_R=1.001", "c_L=0.999"}), {.typed_ahead = "y\n"});
  ASSERT_TRUE(set.shows("[y/N]")) << set.seen();
  set.type("\n");
  EXPECT_EQ(set.wait(), 1);
  EXPECT_EQ(astrolabe({"params", "get", "c_R", "--port", simulator_.port()}).out, "1\n");
}

TEST_F(Terminal, QuestionsAreAnsweredByHand) {
  for (const auto& [answer, code, value] :
       {std::tuple{"n\n", 1, "1\n"}, std::tuple{"\n", 1, "1\n"}, std::tuple{"y\n", 0, "1.001\n"}}) {
    TerminalProgram set(command({"params", "set", "c_R=1.001", "c_L=0.999"}));
    ASSERT_TRUE(set.shows("[y/N]")) << set.seen();
    set.type(answer);
    EXPECT_EQ(set.wait(), code);
    EXPECT_EQ(astrolabe({"params", "get", "c_R", "--port", simulator_.port()}).out, value);
  }
}

}  // namespace
}  // namespace astro
