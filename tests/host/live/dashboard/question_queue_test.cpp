#include "host/live/dashboard/question_queue.hpp"

#include <gmock/gmock.h>

namespace astro::dashboard {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Queue : public testing::Test {
 protected:
  std::vector<std::string> push(const std::string& call, Page page = 1) {
    std::vector<std::string> refused;
    for (const Question& each : queue_.push({page, 0, call})) refused.push_back(each.call);
    return refused;
  }
  std::vector<std::string> popped() {
    std::vector<std::string> calls;
    while (const auto question = queue_.pop()) calls.push_back(question->call);
    return calls;
  }
  QuestionQueue queue_;
};

TEST_F(Queue, KeepsTheOrder) {
  for (const char* call : {"robot/open", "robot/arm", "robot/drive"}) EXPECT_THAT(push(call), IsEmpty());
  EXPECT_THAT(popped(), ElementsAre("robot/open", "robot/arm", "robot/drive"));
}

TEST_F(Queue, AStopOvertakesAllAndWithdrawsWhatWasToMoveTheRobot) {
  push("robot/parameters");
  push("robot/arm", 2);
  push("robot/drive", 2);
  push("robot/record");
  EXPECT_THAT(push("robot/emergency_stop"), ElementsAre("robot/arm", "robot/drive"));
  EXPECT_THAT(push("robot/drive"), IsEmpty()) << "what is asked after the stop is for the robot to refuse";
  EXPECT_THAT(popped(),
              ElementsAre("robot/emergency_stop", "robot/parameters", "robot/record", "robot/drive"));
}

TEST_F(Queue, APauseIsAStop) {
  push("robot/parameters");
  push("robot/path");
  EXPECT_THAT(push("robot/pause"), ElementsAre("robot/path"));
  EXPECT_THAT(popped(), ElementsAre("robot/pause", "robot/parameters"));
}

TEST_F(Queue, APageThatGoesWithdrawsAllItsOwn) {
  for (const char* call : {"robot/open", "robot/watch", "robot/arm", "robot/record", "robot/commit"})
    push(call, 1);
  push("robot/path", 2);
  EXPECT_THAT(push(std::string(kPageGone), 1),
              ElementsAre("robot/open", "robot/watch", "robot/arm", "robot/record", "robot/commit"));
  EXPECT_THAT(popped(), ElementsAre(std::string(kPageGone), "robot/path"));
}

TEST_F(Queue, RefusesWhatIsTooMuchOfOnePageButNeverAStop) {
  for (std::size_t i = 0; i < QuestionQueue::kMost; ++i) EXPECT_THAT(push("robot/parameters"), IsEmpty());
  EXPECT_THAT(push("robot/parameters"), ElementsAre("robot/parameters"));
  EXPECT_THAT(push("robot/parameters", 2), IsEmpty());
  EXPECT_THAT(push("robot/stop"), IsEmpty());
  EXPECT_EQ(queue_.pop()->call, "robot/stop");
}

}  // namespace
}  // namespace astro::dashboard
