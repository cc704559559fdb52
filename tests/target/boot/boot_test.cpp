#include <gtest/gtest.h>

#include <iostream>

#include "host/emulator/core/chip.hpp"
#include "host/emulator/robot/teensy.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/target/firmware_file.hpp"

namespace astro::emulator {
namespace {

using namespace std::chrono_literals;
using target::kImage;

constexpr std::uint32_t kLed = 1U << 3;

TEST(Boot, TheImageStartsAndTheLedBlinksOnceASecond) {
  Teensy teensy(kImage);
  int changes = 0;
  bool last = false;
  for (int ms = 0; ms < 3000; ++ms) {
    teensy.run_for(1ms);
    const bool led = (teensy.gpio7().driven() & kLed) != 0;
    changes += led != last ? 1 : 0;
    last = led;
  }
  EXPECT_EQ(changes, 5);  // every 512 ticks
  std::cout << "  " << teensy.instructions() << " instructions in 3 s\n";
}

TEST(Boot, AFetchFromABusyFlashEndsTheRun) {
  Teensy teensy(kImage);
  teensy.run_for(50ms);
  teensy.flash().write_enable();
  teensy.flash().erase_sector(FlashChip::kParameters);
  teensy.run_for(1ms);  // the image needs nothing from the flash
  teensy.chip().cpu().set(UC_ARM_REG_PC, Memory::kFlash + 0x1031);
  EXPECT_THAT([&] { teensy.run_for(1ms); },
              support::ThrowsTelling(ChipProblem::busy_flash_executed, "0x60001030"));
}

TEST(Boot, AResetWhileTheFlashErasesIsReported) {
  Teensy teensy(kImage);
  teensy.run_for(50ms);
  teensy.flash().write_enable();
  teensy.flash().erase_sector(FlashChip::kParameters);
  teensy.press_reset();
  EXPECT_THROW(teensy.run_for(1ms), Stopped);
}

TEST(Boot, TwoRunsAreTheSame) {
  const auto state = [] {
    Teensy teensy(kImage);
    teensy.run_for(200ms);
    return std::tuple(teensy.now(), teensy.instructions(), teensy.chip().cpu().pc());
  };
  EXPECT_EQ(state(), state());
}

}  // namespace
}  // namespace astro::emulator
