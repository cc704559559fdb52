#include "firmware/app/tick/tick_clock.hpp"

#include <gtest/gtest.h>

namespace astro {
namespace {

TEST(TickClock, AThousandTicksOnTimeProveTheRate) {
  TickClock clock;
  for (std::uint64_t tick = 0; tick < 5000; ++tick) ASSERT_TRUE(clock.advance(7'000 + tick * 1000)) << tick;
  EXPECT_EQ(clock.count(), 5000U);
  EXPECT_EQ(clock.overruns(), 0U);
  EXPECT_EQ(clock.longest_us(), 1000U);
}

TEST(TickClock, LateAndEarlyTicksAreFoundAtOnce) {
  for (const std::uint64_t gap_us : {1'501, 3'000, 499, 0}) {
    TickClock clock;
    clock.advance(1'000);
    clock.advance(2'000);
    EXPECT_FALSE(clock.advance(2'000 + gap_us)) << gap_us;
    EXPECT_EQ(clock.overruns(), 1U);
  }
}

TEST(TickClock, OneLongGapIsToldOnce) {
  TickClock clock;
  std::uint64_t now_us = 0;
  for (int tick = 0; tick < 500; ++tick) clock.advance(now_us += 1000);
  EXPECT_FALSE(clock.advance(now_us += 400'000));
  for (int tick = 0; tick < 3000; ++tick) ASSERT_TRUE(clock.advance(now_us += 1000)) << tick;
  EXPECT_EQ(clock.overruns(), 1U);
}

TEST(TickClock, JitterOfLessThanHalfAPeriodIsNone) {
  TickClock clock;
  for (std::uint64_t tick = 0; tick < 3000; ++tick)
    ASSERT_TRUE(clock.advance(10'000 + tick * 1000 + (tick % 2) * 400)) << tick;
  EXPECT_EQ(clock.longest_us(), 1400U);
}

TEST(TickClock, ARateThatIsOffByAThousandthAndMoreIsFoundWithinASecond) {
  for (const std::uint64_t tenth_us : {9'980, 10'020}) {  // ticks of 0.998 ms and of 1.002 ms
    TickClock clock;
    bool found = false;
    for (std::uint64_t tick = 0; tick < 1001; ++tick) found = !clock.advance(tick * tenth_us / 10) || found;
    EXPECT_TRUE(found) << tenth_us;
  }
  TickClock good;
  for (std::uint64_t tick = 0; tick < 5000; ++tick)
    ASSERT_TRUE(good.advance(tick * 10'005 / 10)) << "half a thousandth is within any crystal and its clock";
}

}  // namespace
}  // namespace astro
