#include "host/ros2/foxglove/request_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace astro::ros2::foxglove {
namespace {

const auto kNone = [](const Request&) { return false; };

TEST(RequestQueue, HandsOutWhatGoesFirstAndOtherwiseTheOldest) {
  RequestQueue queue;
  for (const std::uint32_t service : {1U, 2U, 3U, 2U}) queue.push(CallArrived{7, service, service, {}});
  const auto second = [](const Request& request) { return std::get<CallArrived>(request).service == 2; };
  EXPECT_EQ(queue.size(), 4U);
  for (const std::uint32_t service : {2U, 2U, 1U, 3U})
    EXPECT_EQ(std::get<CallArrived>(*queue.pop(second)).service, service);
  EXPECT_EQ(queue.size(), 0U);
}

TEST(RequestQueue, OfOneTopicKeepsTheNewestMessages) {
  RequestQueue queue;
  queue.push(MessageArrived{2, {99}});
  for (std::uint8_t i = 0; i < 15; ++i) queue.push(MessageArrived{1, {i}});
  queue.push(ParametersAsked{1, {}});
  EXPECT_EQ(std::get<MessageArrived>(*queue.pop(kNone)).inlet, 2U);
  for (std::uint8_t i = 5; i < 15; ++i)
    EXPECT_EQ(std::get<MessageArrived>(*queue.pop(kNone)).message, Bytes{i});
  EXPECT_TRUE(std::holds_alternative<ParametersAsked>(*queue.pop(kNone)));
  EXPECT_FALSE(queue.pop(kNone));
}

TEST(RequestQueue, KeepsABoundedNumberOfNotices) {
  RequestQueue queue;
  for (int i = 0; i < 100; ++i) queue.push(NoticeArrived{});
  std::size_t count = 0;
  while (queue.pop(kNone)) ++count;
  EXPECT_EQ(count, RequestQueue::kMostNotices);
}

TEST(RequestQueue, WaitEndsWhenSomethingComes) {
  RequestQueue queue;
  std::thread other([&] { queue.push(NoticeArrived{}); });
  const auto begin = std::chrono::steady_clock::now();
  queue.wait(std::chrono::seconds(30));  // only a failure waits so long
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  EXPECT_TRUE(queue.pop(kNone));
  other.join();
}

}  // namespace
}  // namespace astro::ros2::foxglove
