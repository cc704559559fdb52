#include "firmware/app/hosts/event_log.hpp"

#include <gtest/gtest.h>

namespace astro {
namespace {

TEST(EventLog, KeepsTimesOfARobotThatHasBeenOnForYears) {
  EventLog<1> log;
  for (const std::uint64_t time_us :
       {std::uint64_t{1}, std::uint64_t{UINT32_MAX} + 5, std::uint64_t{1} << 47}) {
    log.note({time_us, 7, HostEvent::Kind::segment_completed});
    EXPECT_EQ(log.front(0).time_us, time_us);
    log.pop(0);
  }
}

TEST(EventLog, CountsForEachPortWhatWentBeforeItWasRead) {
  EventLog<2> log;
  for (std::uint16_t number = 0; number < 70; ++number) {
    log.note({number, number, HostEvent::Kind::segment_started});
    if (number < 10) log.pop(0);
  }
  EXPECT_EQ(log.missed(0), 0U);
  EXPECT_EQ(log.front(0).number, 10U);
  EXPECT_EQ(log.missed(1), 6U) << "64 of 70 have room";
  EXPECT_EQ(log.front(1).number, 6U);
  log.forget_missed(1);
  EXPECT_EQ(log.missed(1), 0U);
  log.skip(1);
  EXPECT_TRUE(log.empty(1));
  EXPECT_FALSE(log.empty(0));
}

}  // namespace
}  // namespace astro
