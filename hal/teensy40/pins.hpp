#pragma once

#include <array>
#include <cstdint>

#include "hal/teensy40/registers/registers.hpp"

/// THE pin table: what each used pin of the Teensy is wired to, inside and outside. README.md has it in
/// words.
namespace astro::teensy40 {

/// A register of IOMUXC by its offset, and the word it gets; no offset: none.
struct Select {
  std::uint32_t offset = 0, value = 0;
};

struct Pin {
  int number;         // as printed on the Teensy
  std::uint32_t mux;  // offset of SW_MUX_CTL_PAD
  std::uint32_t function;
  std::uint32_t pad;  // offset of SW_PAD_CTL_PAD
  std::uint32_t setting;
  Select input{};  // which pad feeds the function's input
};

/// What a pad does electrically: 3.3 V all of them, none bears 5 V.
namespace pad {
inline constexpr std::uint32_t kOutput =
    0x0000'0020;  // drive strength 4 of 7: enough for logic at 20 kHz, and quiet
inline constexpr std::uint32_t kPullUp = 0x0001'F038;    // 22 kohm up, hysteresis
inline constexpr std::uint32_t kTransmit = 0x0000'00D9;  // a fast output
inline constexpr std::uint32_t kAnalog = 0x0000'0000;    // no keeper: it would bend the divider's voltage
}  // namespace pad

/// Bits of GPIO7, which all pins below that software moves or reads belong to.
namespace gpio7 {
inline constexpr std::uint32_t kLeftForward = 1U << 0, kLeftReverse = 1U << 1;
inline constexpr std::uint32_t kRightForward = 1U << 2, kRightReverse = 1U << 17;
inline constexpr std::uint32_t kDirections = kLeftForward | kLeftReverse | kRightForward | kRightReverse;
inline constexpr std::uint32_t kLeftPwm = 1U << 10, kRightPwm = 1U << 11;  // before FlexPWM has them
inline constexpr std::uint32_t kDriverError = 1U << 16;                    // low: the driver chip reports
inline constexpr std::uint32_t kLed = 1U << 3;
}  // namespace gpio7

#define PAD(name) iomuxc::SW_MUX_CTL_PAD_GPIO_##name.value
#define SETTING(name) iomuxc::SW_PAD_CTL_PAD_GPIO_##name.value
inline constexpr std::uint32_t kGpio = 5;  // on every pad

inline constexpr std::array<Pin, 6> kMotorLogicPins{
    Pin{10, PAD(B0_00), kGpio, SETTING(B0_00), pad::kOutput},   // left IN1
    Pin{12, PAD(B0_01), kGpio, SETTING(B0_01), pad::kOutput},   // left IN2
    Pin{11, PAD(B0_02), kGpio, SETTING(B0_02), pad::kOutput},   // right IN1
    Pin{7, PAD(B1_01), kGpio, SETTING(B1_01), pad::kOutput},    // right IN2
    Pin{8, PAD(B1_00), kGpio, SETTING(B1_00), pad::kPullUp},    // LO1 and LO2, both open drain
    Pin{13, PAD(B0_03), kGpio, SETTING(B0_03), pad::kOutput}};  // LED on the Teensy
inline constexpr std::array<Pin, 2> kPwmPins{
    Pin{6, PAD(B0_10), 2, SETTING(B0_10), pad::kOutput},   // left PWM: FlexPWM2 submodule 2 A
    Pin{9, PAD(B0_11), 2, SETTING(B0_11), pad::kOutput}};  // right PWM: FlexPWM2 submodule 2 B
inline constexpr std::array<Pin, 4> kEncoderPins{
    Pin{2, PAD(EMC_04), 3, SETTING(EMC_04), pad::kPullUp, {iomuxc::XBAR1_IN06_SELECT_INPUT.value, 0}},  // left
                                                                                                        // A
    Pin{3, PAD(EMC_05), 3, SETTING(EMC_05), pad::kPullUp, {iomuxc::XBAR1_IN07_SELECT_INPUT.value, 0}},  // left
                                                                                                        // B
    Pin{4, PAD(EMC_06), 3, SETTING(EMC_06), pad::kPullUp, {iomuxc::XBAR1_IN08_SELECT_INPUT.value, 0}},  // right
                                                                                                        // A
    Pin{5, PAD(EMC_08), 3, SETTING(EMC_08), pad::kPullUp, {iomuxc::XBAR1_IN17_SELECT_INPUT.value, 0}}};  // right
                                                                                                         // B
inline constexpr std::array<Pin, 2> kUartPins{
    Pin{0, PAD(AD_B0_03), 2, SETTING(AD_B0_03), pad::kPullUp, {iomuxc::LPUART6_RX_SELECT_INPUT.value, 1}},
    Pin{1, PAD(AD_B0_02), 2, SETTING(AD_B0_02), pad::kTransmit, {iomuxc::LPUART6_TX_SELECT_INPUT.value, 1}}};
inline constexpr std::array<Pin, 1> kBatteryPins{
    Pin{14, PAD(AD_B1_02), kGpio, SETTING(AD_B1_02), pad::kAnalog}};  // A0, ADC1 channel 7
#undef PAD
#undef SETTING

/// Makes the pins what the table says: electrically first, so that a function never meets an undecided pad.
template <std::size_t N>
inline void apply(const std::array<Pin, N>& pins) {
  const auto at = [](std::uint32_t offset) { return Register<std::uint32_t>(IOMUXC.base + offset); };
  for (const Pin& pin : pins) {
    at(pin.pad).write(pin.setting);
    if (pin.input.offset != 0) at(pin.input.offset).write(pin.input.value);
    at(pin.mux).write(pin.function);
  }
}

}  // namespace astro::teensy40
