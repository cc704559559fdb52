#include <gtest/gtest.h>

#include <iostream>

#include "host/emulator/teensy.hpp"

namespace astro::emulator {
namespace {

using namespace std::chrono_literals;

constexpr const char* kImage = ASTRO_IMAGE_DIR "/astrolabe-teensy40.hex";
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

}  // namespace
}  // namespace astro::emulator
