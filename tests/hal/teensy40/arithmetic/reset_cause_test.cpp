#include "hal/teensy40/arithmetic/reset_cause.hpp"

#include <gtest/gtest.h>

namespace astro::teensy40 {
namespace {

using hal::ResetCause;

constexpr std::uint32_t kPowerOn = 1U << 0, kRequested = 1U << 1, kUser = 1U << 3, kWatchdog12 = 1U << 4,
                        kWatchdog3 = 1U << 7;

TEST(ResetCause, EachBitOfTheResetControllerHasItsMeaning) {
  EXPECT_EQ(reset_cause(kPowerOn, marker::kNone), ResetCause::power_on);
  EXPECT_EQ(reset_cause(kUser, marker::kNone), ResetCause::pin);
  EXPECT_EQ(reset_cause(kWatchdog3, marker::kNone), ResetCause::watchdog);
  EXPECT_EQ(reset_cause(kWatchdog12, marker::kNone), ResetCause::watchdog);
  EXPECT_EQ(reset_cause(0, marker::kNone), ResetCause::unknown);
}

TEST(ResetCause, MarkerTellsAWantedRestartFromAFault) {
  EXPECT_EQ(reset_cause(kRequested, marker::kReboot), ResetCause::software);
  EXPECT_EQ(reset_cause(kRequested, marker::kFault), ResetCause::fault);
}

TEST(ResetCause, RestartThatNobodyAnnouncedIsTheCoresLockUp) {
  EXPECT_EQ(reset_cause(kRequested, marker::kNone), ResetCause::fault);
  EXPECT_EQ(reset_cause(kRequested, 0x1234'5678), ResetCause::fault) << "nor is a stranger's word a marker";
}

TEST(ResetCause, PowerOnForgetsWhatMarkersMaySay) {
  for (const std::uint32_t left : {marker::kReboot, marker::kFault, 0xFFFF'FFFFU})
    EXPECT_EQ(reset_cause(kPowerOn, left), ResetCause::power_on);
}

TEST(ResetCause, WatchdogThatBitesDuringARebootIsTheWatchdog) {
  EXPECT_EQ(reset_cause(kWatchdog3, marker::kReboot), ResetCause::watchdog);
}

}  // namespace
}  // namespace astro::teensy40
