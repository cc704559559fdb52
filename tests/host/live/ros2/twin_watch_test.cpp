#include "host/live/ros2/twin_watch.hpp"

#include <gtest/gtest.h>

namespace astro::live {
namespace {

using std::chrono::seconds;

constexpr TwinWatch::Clock::time_point kStart{};

TEST(TwinWatch, TellsOnceOfATwinThatStays) {
  TwinWatch watch;
  EXPECT_FALSE(watch.note(true, kStart));
  EXPECT_FALSE(watch.note(true, kStart + seconds(7)));
  EXPECT_TRUE(watch.note(true, kStart + seconds(8)));
  EXPECT_FALSE(watch.note(true, kStart + seconds(60)));
}

TEST(TwinWatch, TellsNothingOfOneThatWasKilledAndWhoseLeaseEnds) {
  TwinWatch watch;
  watch.note(true, kStart);
  watch.note(true, kStart + seconds(5));
  watch.note(false, kStart + seconds(6));
  EXPECT_FALSE(watch.note(true, kStart + seconds(10)));
  EXPECT_FALSE(watch.note(true, kStart + seconds(17)));
  EXPECT_TRUE(watch.note(true, kStart + seconds(18)));
}

TEST(TwinWatch, TellsAgainOfANewOne) {
  TwinWatch watch;
  watch.note(true, kStart);
  EXPECT_TRUE(watch.note(true, kStart + seconds(8)));
  watch.note(false, kStart + seconds(10));
  watch.note(true, kStart + seconds(20));
  EXPECT_TRUE(watch.note(true, kStart + seconds(28)));
}

}  // namespace
}  // namespace astro::live
