#include "hal/teensy40/pins.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace astro::teensy40 {
namespace {

std::vector<Pin> all_pins() {
  std::vector<Pin> pins;
  const auto add = [&](const auto& group) { pins.insert(pins.end(), group.begin(), group.end()); };
  add(kLogicPins);
  add(kPwmPins);
  add(kEncoderPins);
  add(kUartPins);
  add(kBatteryPins);
  return pins;
}

/// Pads B0_00..B0_15 and B1_00..B1_15 are bits 0 to 31 of GPIO2 and GPIO7, in the order of their registers.
std::uint32_t gpio7_bit(int number) {
  for (const Pin& pin : all_pins())
    if (pin.number == number) return 1U << (pin.pad.function - iomuxc::SW_MUX_CTL_PAD_GPIO_B0_00.value) / 4;
  ADD_FAILURE() << "no pin " << number;
  return 0;
}

TEST(Pins, NoneIsUsedTwice) {
  std::set<int> numbers;
  std::set<std::uint32_t> pads, sources;
  for (const Pin& pin : all_pins()) {
    EXPECT_TRUE(numbers.insert(pin.number).second) << pin.number;
    EXPECT_TRUE(pads.insert(pin.pad.function).second) << pin.number;
    if (pin.source.offset == 0) continue;
    EXPECT_TRUE(sources.insert(pin.source.offset).second) << pin.number << " shares its input";
  }
}

TEST(Pins, BothRegistersOfAPinAreThoseOfOnePad) {
  // The chip lists its pads twice in the same order: first the functions, then 0x1F0 further the settings.
  for (const Pin& pin : all_pins()) EXPECT_EQ(pin.pad.setting - pin.pad.function, 0x1F0U) << pin.number;
}

TEST(Pins, SoftwareMovesTheBitsOfThePinsInTheTable) {
  EXPECT_EQ(gpio7::kLeftForward, gpio7_bit(10));
  EXPECT_EQ(gpio7::kLeftReverse, gpio7_bit(12));
  EXPECT_EQ(gpio7::kRightForward, gpio7_bit(11));
  EXPECT_EQ(gpio7::kRightReverse, gpio7_bit(7));
  EXPECT_EQ(gpio7::kLeftPwm, gpio7_bit(6));
  EXPECT_EQ(gpio7::kRightPwm, gpio7_bit(9));
  EXPECT_EQ(gpio7::kDriverError, gpio7_bit(8));
  EXPECT_EQ(gpio7::kLed, gpio7_bit(13));
}

TEST(Pins, InputsThatMayHangInTheAirArePulledUp) {
  for (const Pin& pin : kEncoderPins) EXPECT_EQ(pin.setting, setting::kPullUp);
  EXPECT_EQ(kUartPins[0].setting, setting::kPullUp);
}

TEST(Pins, SettingsSayWhatTheirNamesDo) {
  constexpr Bits kKeeperOrPull{12, 1}, kPull{13, 1}, kUp22k{14, 2}, kHysteresis{16, 1}, kDrive{3, 3};
  EXPECT_EQ(kKeeperOrPull.of(setting::kAnalog), 0U);
  EXPECT_EQ(kKeeperOrPull.of(setting::kOutput), 0U);
  EXPECT_GT(kDrive.of(setting::kOutput), 0U) << "0 switches the driver off";
  EXPECT_EQ(kPull.of(setting::kPullUp) & kKeeperOrPull.of(setting::kPullUp), 1U);
  EXPECT_EQ(kUp22k.of(setting::kPullUp), 3U);
  EXPECT_EQ(kHysteresis.of(setting::kPullUp), 1U);
}

}  // namespace
}  // namespace astro::teensy40
