#include "host/ros2/node/twin_watch.hpp"

#include <gtest/gtest.h>

namespace astro::ros2 {
namespace {

using std::chrono::seconds;

constexpr TwinWatch::Clock::time_point kStart{};

TEST(TwinWatch, TellsOnceOfATwinThatStays) {
  TwinWatch watch;
  EXPECT_FALSE(watch.note(true, kStart));
  EXPECT_FALSE(watch.note(true, kStart + seconds(24)));
  EXPECT_TRUE(watch.note(true, kStart + seconds(25)));
  EXPECT_FALSE(watch.note(true, kStart + seconds(60)));
}

TEST(TwinWatch, TellsNothingOfOneThatWasKilledAndWhoseLeaseEnds) {
  TwinWatch watch;
  watch.note(true, kStart);
  watch.note(true, kStart + seconds(20));
  watch.note(false, kStart + seconds(21));
  EXPECT_FALSE(watch.note(true, kStart + seconds(30)));
  EXPECT_FALSE(watch.note(true, kStart + seconds(54)));
  EXPECT_TRUE(watch.note(true, kStart + seconds(55)));
}

TEST(TwinWatch, TellsAgainOfANewOne) {
  TwinWatch watch;
  watch.note(true, kStart);
  EXPECT_TRUE(watch.note(true, kStart + seconds(30)));
  watch.note(false, kStart + seconds(40));
  watch.note(true, kStart + seconds(50));
  EXPECT_TRUE(watch.note(true, kStart + seconds(80)));
}

}  // namespace
}  // namespace astro::ros2
