#pragma once

#include <array>
#include <cstdint>

#include "hal/teensy40/registers/registers.hpp"

/// THE pin table: the pad and the function of each used pin of the Teensy. README.md explains it.
namespace astro::teensy40 {

/// The registers of a pad in IOMUXC: its function, its electrical settings.
struct Pad {
  std::uint32_t function, setting;
};

/// Which pad feeds an input of a peripheral: a register of IOMUXC and its word. No offset: nothing to choose.
struct Source {
  std::uint32_t offset = 0, value = 0;
};

struct Pin {
  int number;  // as printed on the Teensy
  Pad pad;
  std::uint32_t function, setting;
  Source source{};
};

/// Electrical settings. All pads work at 3.3 V; none tolerates 5 V.
namespace setting {
inline constexpr std::uint32_t kOutput = 0x0000'0020;    // drive 4 of 7: enough for 20 kHz, and quiet
inline constexpr std::uint32_t kPullUp = 0x0001'F038;    // input, 22 kohm up, hysteresis
inline constexpr std::uint32_t kTransmit = 0x0000'00D9;  // a fast output
inline constexpr std::uint32_t kAnalog = 0x0000'0000;    // no keeper: it would bend the divider's voltage
inline constexpr std::uint32_t kTwoWire =
    0x0001'F860;  // open drain with 22 kohm up, for a bus without a sensor
}  // namespace setting

/// Bits of GPIO7: all pins that software moves or reads belong to it.
namespace gpio7 {
inline constexpr std::uint32_t kLeftForward = 1U << 0, kLeftReverse = 1U << 1;
inline constexpr std::uint32_t kRightForward = 1U << 2, kRightReverse = 1U << 17;
inline constexpr std::uint32_t kDirections = kLeftForward | kLeftReverse | kRightForward | kRightReverse;
inline constexpr std::uint32_t kLeftPwm = 1U << 10, kRightPwm = 1U << 11;  // until FlexPWM has them
inline constexpr std::uint32_t kDriverError = 1U << 16;                    // low: the driver chip reports
inline constexpr std::uint32_t kLed = 1U << 3;
}  // namespace gpio7

/// Bits of GPIO1, which frees the I2C bus.
namespace gpio1 {
inline constexpr std::uint32_t kScl = 1U << 16, kSda = 1U << 17;
}  // namespace gpio1

#define PAD(name) \
  { iomuxc::SW_MUX_CTL_PAD_GPIO_##name.value, iomuxc::SW_PAD_CTL_PAD_GPIO_##name.value }
#define SOURCE(input, choice) \
  { iomuxc::input##_SELECT_INPUT.value, choice }

inline constexpr std::uint32_t kGpio = 5;  // on every pad
inline constexpr std::array<Pin, 6> kLogicPins{{
    {10, PAD(B0_00), kGpio, setting::kOutput, {}},  // left IN1
    {12, PAD(B0_01), kGpio, setting::kOutput, {}},  // left IN2
    {11, PAD(B0_02), kGpio, setting::kOutput, {}},  // right IN1
    {7, PAD(B1_01), kGpio, setting::kOutput, {}},   // right IN2
    {8, PAD(B1_00), kGpio, setting::kPullUp, {}},   // LO1 and LO2, both open drain
    {13, PAD(B0_03), kGpio, setting::kOutput, {}},  // LED on the Teensy
}};
inline constexpr std::array<Pin, 2> kPwmPins{{
    {6, PAD(B0_10), 2, setting::kOutput, {}},  // left: FlexPWM2, submodule 2, A
    {9, PAD(B0_11), 2, setting::kOutput, {}},  // right: B
}};
inline constexpr std::array<Pin, 4> kEncoderPins{{
    {2, PAD(EMC_04), 3, setting::kPullUp, SOURCE(XBAR1_IN06, 0)},  // left A
    {3, PAD(EMC_05), 3, setting::kPullUp, SOURCE(XBAR1_IN07, 0)},  // left B
    {4, PAD(EMC_06), 3, setting::kPullUp, SOURCE(XBAR1_IN08, 0)},  // right A
    {5, PAD(EMC_08), 3, setting::kPullUp, SOURCE(XBAR1_IN17, 0)},  // right B
}};
inline constexpr std::array<Pin, 2> kUartPins{{
    {0, PAD(AD_B0_03), 2, setting::kPullUp, SOURCE(LPUART6_RX, 1)},
    {1, PAD(AD_B0_02), 2, setting::kTransmit, SOURCE(LPUART6_TX, 1)},
}};
inline constexpr std::array<Pin, 1> kBatteryPins{{
    {14, PAD(AD_B1_02), kGpio, setting::kAnalog, {}},  // A0: ADC1 channel 7
}};
inline constexpr std::uint32_t kReadBack = 1U << 4;  // SION: the controller sees what it drives
inline constexpr std::array<Pin, 2> kI2cPins{{
    {19, PAD(AD_B1_00), 3 | kReadBack, setting::kTwoWire, SOURCE(LPI2C1_SCL, 1)},
    {18, PAD(AD_B1_01), 3 | kReadBack, setting::kTwoWire, SOURCE(LPI2C1_SDA, 1)},
}};
inline constexpr std::array<Pin, 2> kI2cPinsByHand{{
    {19, PAD(AD_B1_00), kGpio | kReadBack, setting::kTwoWire, {}},
    {18, PAD(AD_B1_01), kGpio | kReadBack, setting::kTwoWire, {}},
}};
#undef SOURCE
#undef PAD

/// Sets up the pins of the table, electrical settings first, so that a function never starts on an undefined
/// pad.
template <std::size_t N>
inline void apply(const std::array<Pin, N>& pins) {
  const auto at = [](std::uint32_t offset) { return Register<std::uint32_t>(IOMUXC.base + offset); };
  for (const Pin& pin : pins) {
    at(pin.pad.setting).write(pin.setting);
    if (pin.source.offset != 0) at(pin.source.offset).write(pin.source.value);
    at(pin.pad.function).write(pin.function);
  }
}

}  // namespace astro::teensy40
