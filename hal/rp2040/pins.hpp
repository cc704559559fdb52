#pragma once

#include <array>
#include <cstdint>

#include "hal/rp2040/registers/registers.hpp"

/// THE pin table: function and electrical settings of each used pin of the Pico. README.md explains it.
namespace astro::rp2040 {

enum class Function : std::uint32_t { uart = 2, pwm = 4, software = 5, pio0 = 6, none = 31 };

struct Pin {
  std::uint32_t number;  // GP..., not the number of the pad on the board
  Function function;
  std::uint32_t setting;
};

/// Electrical settings. All pads work at 3.3 V; none tolerates 5 V.
namespace setting {
// Driven at 4 mA; the pull-down stays, so that a bridge is open also while the pin does not drive.
inline constexpr std::uint32_t kOutput =
    pads::GPIO0_IE(1) | pads::GPIO0_DRIVE(1) | pads::GPIO0_SCHMITT(1) | pads::GPIO0_PDE(1);
inline constexpr std::uint32_t kPullUp =
    pads::GPIO0_IE(1) | pads::GPIO0_SCHMITT(1) | pads::GPIO0_PUE(1) | pads::GPIO0_OD(1);
inline constexpr std::uint32_t kTransmit = pads::GPIO0_IE(1) | pads::GPIO0_DRIVE(1) | pads::GPIO0_SCHMITT(1);
inline constexpr std::uint32_t kAnalog = pads::GPIO0_OD(1);  // no pull: it would bend the divider's voltage
}  // namespace setting

namespace gp {
inline constexpr std::uint32_t kTransmit = 0, kReceive = 1;
inline constexpr std::uint32_t kLeftA = 2,
                               kRightA = 4;  // B is the next one, because a PIO program reads neighbours
inline constexpr std::uint32_t kLeftIn1 = 6, kLeftIn2 = 7, kRightIn1 = 8, kRightIn2 = 9;
inline constexpr std::uint32_t kEnable = 10, kDriverError = 11, kLed = 25, kBattery = 26;
}  // namespace gp

/// A pair of neighbours from an even number on belongs to one slice of the PWM: 6 and 7 to slice 3, 8 and 9 to slice 4.
namespace slice {
inline constexpr std::uint32_t kLeft = gp::kLeftIn1 / 2, kRight = gp::kRightIn1 / 2;
static_assert(gp::kLeftIn1 % 2 == 0 && gp::kLeftIn2 == gp::kLeftIn1 + 1);
static_assert(gp::kRightIn1 % 2 == 0 && gp::kRightIn2 == gp::kRightIn1 + 1);
}  // namespace slice

inline constexpr std::array<Pin, 3> kLogicPins{{
    {gp::kEnable, Function::software, setting::kOutput},  // STBY, nSLEEP, or PWMA and PWMB of the driver chip
    {gp::kDriverError, Function::software, setting::kPullUp},  // nFAULT, or LO1 and LO2: open drain
    {gp::kLed, Function::software, setting::kOutput},          // on the Pico
}};
inline constexpr std::array<Pin, 4> kBridgePins{{
    {gp::kLeftIn1, Function::pwm, setting::kOutput},
    {gp::kLeftIn2, Function::pwm, setting::kOutput},
    {gp::kRightIn1, Function::pwm, setting::kOutput},
    {gp::kRightIn2, Function::pwm, setting::kOutput},
}};
inline constexpr std::array<Pin, 4> kEncoderPins{{
    {gp::kLeftA, Function::pio0, setting::kPullUp},
    {gp::kLeftA + 1, Function::pio0, setting::kPullUp},
    {gp::kRightA, Function::pio0, setting::kPullUp},
    {gp::kRightA + 1, Function::pio0, setting::kPullUp},
}};
inline constexpr std::array<Pin, 2> kUartPins{{
    {gp::kTransmit, Function::uart, setting::kTransmit},
    {gp::kReceive, Function::uart, setting::kPullUp},
}};
inline constexpr std::array<Pin, 1> kBatteryPins{{
    {gp::kBattery, Function::none, setting::kAnalog},  // ADC channel 0
}};

inline Register control_of(std::uint32_t pin) { return IO_BANK0.at(io::GPIO0_CTRL, pin, 8); }

/// Sets up the pins of the table, electrical settings first, so that a function never starts on an undefined pin. Needs
/// pads and IO_BANK0 out of reset.
template <std::size_t N>
inline void apply(const std::array<Pin, N>& pins) {
  for (const Pin& pin : pins) {
    PADS_BANK0.at(pads::GPIO0, pin.number, 4).write(pin.setting);
    control_of(pin.number).write(io::GPIO0_CTRL_FUNCSEL(static_cast<std::uint32_t>(pin.function)));
  }
}

}  // namespace astro::rp2040
