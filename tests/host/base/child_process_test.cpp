#include "host/base/child_process.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace astro {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;

constexpr milliseconds kLong = seconds(60);

struct Heard {
  std::string bytes;
  std::vector<std::string> lines;
  std::optional<int> status;
};

Heard heard_of(const std::string& script, ChildProcess::Output output) {
  Heard heard;
  ChildProcess child;
  const int failure = child.start({"sh", "-c", script}, output,
                                  [&](std::string_view line) { heard.lines.emplace_back(line); });
  EXPECT_EQ(failure, 0);
  std::array<std::uint8_t, 16> some{};
  while (child.writes_bytes() || child.writes_lines()) {
    EXPECT_TRUE(child.wait(kLong));
    if (child.writes_bytes()) heard.bytes.append(some.begin(), some.begin() + child.read(some));
  }
  heard.status = child.finish(kLong);
  return heard;
}

TEST(ChildProcess, HasOutputAndErrorsApart) {
  const Heard heard =
      heard_of("printf 'one\ntwo'; printf 'three\r\n\nfour' >&2; exit 5", ChildProcess::Output::bytes);
  EXPECT_EQ(heard.bytes, "one\ntwo");
  EXPECT_THAT(heard.lines, ElementsAre("three", "four"));
  EXPECT_EQ(heard.status, 5);
}

TEST(ChildProcess, SaysBothAsLinesInTheirOrderIfAsked) {
  const Heard heard = heard_of("echo one; echo two >&2; echo three", ChildProcess::Output::lines);
  EXPECT_EQ(heard.bytes, "");
  EXPECT_THAT(heard.lines, ElementsAre("one", "two", "three"));
  EXPECT_EQ(heard.status, 0);
}

TEST(ChildProcess, ReadsNothingFromTheTerminalOfThisProgram) {
  EXPECT_THAT(heard_of("cat; echo end", ChildProcess::Output::lines).lines, ElementsAre("end"));
}

TEST(ChildProcess, HasNoExitStatusIfASignalEndsIt) {
  EXPECT_EQ(heard_of("kill -9 $$", ChildProcess::Output::lines).status, std::nullopt);
}

TEST(ChildProcess, OfWhichThereIsNoProgramIsNotStarted) {
  for (const char* name : {"astrolabe-has-no-such-program", "/dev/null"}) {
    ChildProcess child;
    const int failure = child.start({name}, ChildProcess::Output::lines, [](std::string_view) {});
    EXPECT_EQ(failure, *name == '/' ? EACCES : ENOENT);
    EXPECT_FALSE(child.writes_lines());
  }
}

TEST(ChildProcess, ThatSaysNothingIsToldFromOneThatEndsAndIsKilledInTheEnd) {
  ChildProcess child;
  ASSERT_EQ(child.start({"sh", "-c", "exec sleep 100"}, ChildProcess::Output::lines, [](std::string_view) {}),
            0);
  EXPECT_FALSE(child.wait(milliseconds(20)));
  EXPECT_EQ(child.finish(milliseconds(20)), std::nullopt);
  EXPECT_TRUE(child.wait(kLong)) << "its stream has ended";
  EXPECT_FALSE(child.writes_lines());
}

TEST(ChildProcess, MayEndByItselfWhenAsked) {
  ChildProcess child;
  std::string said;
  ASSERT_EQ(child.start({"sh", "-c", "trap 'exit 7' TERM; echo ready; while :; do sleep 0.01; done"},
                        ChildProcess::Output::lines, [&](std::string_view line) { said = line; }),
            0);
  EXPECT_TRUE(child.wait(kLong));
  EXPECT_EQ(said, "ready");
  child.terminate();
  EXPECT_EQ(child.finish(kLong), 7);
}

TEST(ChildProcess, EndsWithItsObject) {
  std::string pid;
  {
    ChildProcess child;
    ASSERT_EQ(child.start({"sh", "-c", "echo $$; exec sleep 100"}, ChildProcess::Output::lines,
                          [&](std::string_view line) { pid = line; }),
              0);
    EXPECT_TRUE(child.wait(kLong));
  }
  ASSERT_NE(pid, "");
  EXPECT_EQ(kill(std::stoi(pid), 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

}  // namespace
}  // namespace astro
