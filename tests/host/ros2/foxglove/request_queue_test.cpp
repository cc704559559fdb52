#include "host/ros2/foxglove/request_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace astro::ros2::foxglove {
namespace {

TEST(RequestQueue, OfOneTopicKeepsTheNewestMessages) {
  RequestQueue queue;
  queue.push(MessageArrived{2, {99}});
  for (std::uint8_t i = 0; i < 15; ++i) queue.push(MessageArrived{1, {i}});
  queue.push(ParametersAsked{1, {}});
  EXPECT_EQ(std::get<MessageArrived>(*queue.pop()).inlet, 2U);
  for (std::uint8_t i = 5; i < 15; ++i) EXPECT_EQ(std::get<MessageArrived>(*queue.pop()).message, Bytes{i});
  EXPECT_TRUE(std::holds_alternative<ParametersAsked>(*queue.pop()));
  EXPECT_FALSE(queue.pop());
}

TEST(RequestQueue, KeepsABoundedNumberOfNotices) {
  RequestQueue queue;
  for (int i = 0; i < 100; ++i) queue.push(NoticeArrived{});
  std::size_t count = 0;
  while (queue.pop()) ++count;
  EXPECT_EQ(count, RequestQueue::kMostNotices);
}

TEST(RequestQueue, WaitEndsWhenSomethingComes) {
  RequestQueue queue;
  std::thread other([&] { queue.push(NoticeArrived{}); });
  const auto begin = std::chrono::steady_clock::now();
  queue.wait(std::chrono::seconds(30));  // only a failure waits so long
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  EXPECT_TRUE(queue.pop());
  other.join();
}

}  // namespace
}  // namespace astro::ros2::foxglove
