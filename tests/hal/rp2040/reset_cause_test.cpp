#include "hal/rp2040/arithmetic/reset_cause.hpp"

#include <gtest/gtest.h>

namespace astro::rp2040 {
namespace {

using hal::ResetCause;
constexpr std::uint32_t kTimer = 1, kForce = 2, kPor = 1U << 8, kRun = 1U << 16;

TEST(PicoResetCause, SupplyAndPinShowOnlyWhereTheWatchdogHasNotRestarted) {
  EXPECT_EQ(reset_cause(0, kPor, marker::kNone), ResetCause::power_on);
  EXPECT_EQ(reset_cause(0, kRun, marker::kNone), ResetCause::pin);
  EXPECT_EQ(reset_cause(0, kRun, marker::kRunning), ResetCause::pin);
  EXPECT_EQ(reset_cause(kTimer, kPor, marker::kRunning), ResetCause::watchdog) << "the cause before stays";
  EXPECT_EQ(reset_cause(0, 0, 0x1234'5678), ResetCause::unknown);
}

TEST(PicoResetCause, MarkerTellsTheWatchdogsRestartsApart) {
  for (const std::uint32_t reason : {kTimer, kForce}) {
    EXPECT_EQ(reset_cause(reason, kPor, marker::kReboot), ResetCause::software);
    EXPECT_EQ(reset_cause(reason, kPor, marker::kFault), ResetCause::fault);
    EXPECT_EQ(reset_cause(reason, kPor, marker::kNone), ResetCause::software)
        << "the boot ROM, after a new program";
  }
  EXPECT_EQ(reset_cause(kForce, kPor, marker::kRunning), ResetCause::unknown) << "nobody said why";
}

}  // namespace
}  // namespace astro::rp2040
