#include "common/safety/pending_faults.hpp"

#include <gtest/gtest.h>

namespace astro {
namespace {

constexpr std::uint64_t kSecond = 1'000'000, kMinute = 60 * kSecond;

FaultCircumstances at(std::uint64_t time_us, Fault fault) { return {.time_us = time_us, .fault = fault}; }

TEST(PendingFaults, ComeOutInTheOrderInWhichTheyCame) {
  PendingFaults pending;
  EXPECT_TRUE(pending.empty());
  pending.offer(at(5, Fault::stall));
  pending.offer(at(6, Fault::driver));
  EXPECT_EQ(pending.pop(), at(5, Fault::stall));
  pending.offer(at(7, Fault::encoder));
  EXPECT_EQ(pending.pop(), at(6, Fault::driver));
  EXPECT_EQ(pending.pop(), at(7, Fault::encoder));
  EXPECT_TRUE(pending.empty());
}

TEST(PendingFaults, TheOldestAreKeptAndTheRestIsCounted) {
  PendingFaults pending;
  for (std::size_t i = 0; i < PendingFaults::kRoom + 3; ++i) pending.offer(at(i, static_cast<Fault>(1 + i)));
  for (std::size_t i = 0; i < PendingFaults::kRoom; ++i)
    EXPECT_EQ(pending.pop(), at(i, static_cast<Fault>(1 + i)));
  EXPECT_TRUE(pending.empty());
  pending.offer(at(9, Fault::emergency_stop));
  EXPECT_EQ(pending.pop().missed, 3);
  pending.offer(at(10, Fault::stall));
  EXPECT_EQ(pending.pop().missed, 0);
}

TEST(PendingFaults, TheSameFaultCountsOnceASecond) {
  PendingFaults pending;
  for (std::uint64_t time = 0; time < kSecond; time += 1000) pending.offer(at(time, Fault::stall));
  EXPECT_EQ(pending.pop(), at(0, Fault::stall));
  EXPECT_TRUE(pending.empty());
  pending.offer(at(kSecond, Fault::stall));
  EXPECT_EQ(pending.pop().missed, 999);
}

TEST(PendingFaults, AStormOfADayIsAnEntryAMinute) {
  PendingFaults pending;
  std::uint64_t logged = 0;
  for (std::uint64_t time = 0; time < 24 * 60 * kMinute; time += 10'000) {
    pending.offer(at(time, static_cast<Fault>(1 + time / 10'000 % 12)));
    if (pending.empty()) continue;
    pending.pop();
    ++logged;
  }
  EXPECT_GE(logged, 24U * 60);
  EXPECT_LE(logged, 24U * 60 + PendingFaults::kBurst);
}

TEST(PendingFaults, AfterAQuietTimeABurstIsLoggedWhole) {
  PendingFaults pending;
  for (int burst = 0; burst < 3; ++burst) {
    const std::uint64_t begin = static_cast<std::uint64_t>(burst) * 20 * kMinute;
    for (std::uint64_t i = 0; i < PendingFaults::kBurst; ++i) {
      pending.offer(at(begin + i * 2 * kSecond, Fault::emergency_stop));
      ASSERT_FALSE(pending.empty()) << "burst " << burst << " fault " << i;
      pending.pop();
    }
    pending.offer(at(begin + 60 * kSecond - 1, Fault::stall));
    EXPECT_TRUE(pending.empty());
  }
}

}  // namespace
}  // namespace astro
