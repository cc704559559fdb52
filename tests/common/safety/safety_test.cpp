#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "common/safety/fault_latch.hpp"
#include "common/safety/watch.hpp"

namespace astro {
namespace {

TEST(Fault, NamesAreDistinctAndUnknownOnesAreAQuestionMark) {
  EXPECT_EQ((std::set<std::string_view>(kFaultNames.begin(), kFaultNames.end()).size()), kFaultNames.size());
  EXPECT_EQ(name(Fault::driver), "driver");
  EXPECT_EQ(name(Fault::emergency_stop), "emergency_stop");
  EXPECT_EQ(name(static_cast<Fault>(kFaultNames.size())), "?");
}

TEST(Fault, EveryFaultHasABitOfItsOwnAndNoneHasNone) {
  EXPECT_EQ(bit(Fault::none), 0U);
  std::uint32_t all = 0;
  for (std::size_t i = 1; i < kFaultNames.size(); ++i) {
    EXPECT_EQ(bit(static_cast<Fault>(i)), 1U << i);
    all |= bit(static_cast<Fault>(i));
  }
  EXPECT_EQ(all, (1U << kFaultNames.size()) - 2);
}

TEST(FaultLatch, KeepsTheFirstFaultItsTimeAndTheMaskOfAll) {
  FaultLatch latch;
  EXPECT_FALSE(latch.any());
  EXPECT_TRUE(latch.raise(Fault::stall, 1000));
  EXPECT_TRUE(latch.raise(Fault::driver, 2000));
  EXPECT_EQ(latch.first(), Fault::stall);
  EXPECT_EQ(latch.first_time_us(), 1000U);
  EXPECT_EQ(latch.mask(), bit(Fault::stall) | bit(Fault::driver));
  EXPECT_EQ(latch.raised(), 2U);
}

TEST(FaultLatch, AFaultThatGoesOnCountsOnce) {
  FaultLatch latch;
  EXPECT_TRUE(latch.raise(Fault::stall, 1000));
  for (std::uint64_t time = 1001; time < 1100; ++time) EXPECT_FALSE(latch.raise(Fault::stall, time));
  EXPECT_EQ(latch.raised(), 1U);
  EXPECT_EQ(latch.first_time_us(), 1000U);
}

TEST(FaultLatch, NoneIsNoFault) {
  FaultLatch latch;
  EXPECT_FALSE(latch.raise(Fault::none, 5));
  EXPECT_FALSE(latch.any());
}

TEST(FaultLatch, ClearReleasesAllButTheCountSinceStart) {
  FaultLatch latch;
  latch.raise(Fault::stall, 1000);
  latch.raise(Fault::driver, 1000);
  latch.clear();
  EXPECT_FALSE(latch.any());
  EXPECT_EQ(latch.first(), Fault::none);
  EXPECT_EQ(latch.first_time_us(), 0U);
  EXPECT_EQ(latch.raised(), 2U);
  EXPECT_TRUE(latch.raise(Fault::stall, 3000)) << "the same fault again is news again";
  EXPECT_EQ(latch.first_time_us(), 3000U);
  EXPECT_EQ(latch.raised(), 3U);
}

TEST(Watch, FiresInTheTickInWhichTheLimitIsFull) {
  Watch watch;
  for (int i = 0; i < 19; ++i) EXPECT_FALSE(watch.advance(true, 20)) << i;
  EXPECT_TRUE(watch.advance(true, 20));
  EXPECT_TRUE(watch.advance(true, 20)) << "and goes on";
}

TEST(Watch, OneGoodTickStartsItAfresh) {
  Watch watch;
  for (int i = 0; i < 19; ++i) watch.advance(true, 20);
  EXPECT_FALSE(watch.advance(false, 20));
  for (int i = 0; i < 19; ++i) EXPECT_FALSE(watch.advance(true, 20)) << i;
  EXPECT_TRUE(watch.advance(true, 20));
}

TEST(Watch, ResetForgets) {
  Watch watch;
  for (int i = 0; i < 19; ++i) watch.advance(true, 20);
  watch.reset();
  EXPECT_FALSE(watch.advance(true, 20));
}

}  // namespace
}  // namespace astro
