#include "hal/teensy40/arithmetic/lut.hpp"

#include <gtest/gtest.h>

namespace astro::teensy40 {
namespace {

// The words that drivers in use write for the same commands (PJRC's eeprom emulation, NXP's examples).
TEST(FlashCommands, AreTheWordsThatTheChipIsKnownToTake) {
  EXPECT_EQ(kWriteEnable, (FlashCommand{0x0000'0406, 0}));
  EXPECT_EQ(kReadStatus, (FlashCommand{0x2401'0405, 0}));
  EXPECT_EQ(kEraseSector, (FlashCommand{0x0818'0420, 0}));
  EXPECT_EQ(kProgramPage, (FlashCommand{0x0818'0432, 0x0000'2201}));
}

}  // namespace
}  // namespace astro::teensy40
