#include "host/live/foxglove/request_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace astro::foxglove {
namespace {

const auto kAlike = [](const Request&) { return 0; };

TEST(RequestQueue, HandsOutTheLowestRankFirstAndOfOneRankTheOldest) {
  RequestQueue queue;
  for (const std::uint32_t service : {1U, 2U, 3U, 2U}) queue.push(CallArrived{7, service, service, {}});
  const auto second = [](const Request& request) {
    return std::get<CallArrived>(request).service == 2 ? 0 : 1;
  };
  EXPECT_EQ(queue.size(), 4U);
  for (const std::uint32_t service : {2U, 2U, 1U, 3U})
    EXPECT_EQ(std::get<CallArrived>(*queue.pop(second, 1)).service, service);
  EXPECT_EQ(queue.size(), 0U);
}

TEST(RequestQueue, KeepsWhatIsAboveTheLastRank) {
  RequestQueue queue;
  queue.push(ParametersAsked{1, {}});
  queue.push(MessageArrived{1, {5}});
  const auto rank = [](const Request& request) {
    return std::holds_alternative<MessageArrived>(request) ? 0 : 1;
  };
  EXPECT_TRUE(queue.pop(rank, 0));
  EXPECT_FALSE(queue.pop(rank, 0));
  EXPECT_EQ(queue.size(), 1U);
  EXPECT_TRUE(queue.pop(rank, 1));
}

TEST(RequestQueue, OfOneTopicKeepsTheNewestMessages) {
  RequestQueue queue;
  queue.push(MessageArrived{2, {99}});
  for (std::uint8_t i = 0; i < 15; ++i) queue.push(MessageArrived{1, {i}});
  queue.push(ParametersAsked{1, {}});
  EXPECT_EQ(std::get<MessageArrived>(*queue.pop(kAlike, 0)).inlet, 2U);
  for (std::uint8_t i = 5; i < 15; ++i)
    EXPECT_EQ(std::get<MessageArrived>(*queue.pop(kAlike, 0)).message, Bytes{i});
  EXPECT_TRUE(std::holds_alternative<ParametersAsked>(*queue.pop(kAlike, 0)));
  EXPECT_FALSE(queue.pop(kAlike, 0));
}

TEST(RequestQueue, KeepsABoundedNumberOfNotices) {
  RequestQueue queue;
  for (int i = 0; i < 100; ++i) queue.push(NoticeArrived{});
  std::size_t count = 0;
  while (queue.pop(kAlike, 0)) ++count;
  EXPECT_EQ(count, RequestQueue::kMostNotices);
}

TEST(RequestQueue, WaitEndsWhenSomethingComes) {
  RequestQueue queue;
  std::thread other([&] { queue.push(NoticeArrived{}); });
  const auto begin = std::chrono::steady_clock::now();
  queue.wait(std::chrono::seconds(30));  // only a failure waits so long
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  EXPECT_TRUE(queue.pop(kAlike, 0));
  other.join();
}

}  // namespace
}  // namespace astro::foxglove
