#include "host/console/terminal.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <string>
#include <vector>

#include "host/console/console.hpp"
#include "host/console/program.hpp"

namespace astro::console {
namespace {

TEST(Gauge, GrowsFromTheMiddleToEitherSide) {
  EXPECT_EQ(gauge(0, 3), "░░░┃░░░");
  EXPECT_EQ(gauge(1, 3), "░░░┃███");
  EXPECT_EQ(gauge(-1, 3), "███┃░░░");
  EXPECT_EQ(gauge(0.34, 3), "░░░┃█░░");
  EXPECT_EQ(gauge(-7, 3), gauge(-1, 3));
}

TEST(Table, AlignsAsAskedAndByCharacters) {
  EXPECT_EQ(table({{"a", "bb"}, {"ccc", "d"}}), "a    bb\nccc   d\n");
  EXPECT_EQ(table({{"a", "bb"}, {"ü", "d"}}, "rl"), "a  bb\nü  d\n");
}

TEST(ProgressLines, ComeAfterTenSecondsThenEverMoreRarelyButEveryMinute) {
  ProgressLines lines;
  std::vector<int> due;
  for (int second = 0; second <= 300; ++second)
    if (lines.due(std::chrono::seconds(second))) due.push_back(second);
  EXPECT_THAT(due, testing::ElementsAre(10, 20, 40, 80, 140, 200, 260));
}

/// Two programs use this library; none may complain under the other's name.
TEST(Complaint, BeginsWithTheNameOfTheProgramThatRuns) {
  for (const char* name : {"astrolabe", "astrolabe-emulator"}) {
    const Program program(name, "");
    testing::internal::CaptureStderr();
    complain("the disk is full");
    complain_without_memory("there is no memory");
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              std::string(name) + ": the disk is full\n" + name + ": there is no memory\n");
  }
}

}  // namespace
}  // namespace astro::console
