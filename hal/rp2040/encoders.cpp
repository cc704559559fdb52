#include "hal/rp2040/encoders.hpp"

#include "hal/rp2040/arithmetic/quadrature.hpp"
#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/pins.hpp"

namespace astro::rp2040 {
namespace {

constexpr std::uint32_t kStride = 0x18;  // from machine to machine
constexpr std::uint32_t kBoth = 3;       // machines 0 and 1

void load_program() {
  for (std::uint32_t at = 0; at < QuadratureProgram::kLength; ++at)
    PIO0.at(pio::INSTR_MEM0, at, 4).write(kQuadrature.code[at]);
}

void execute(std::uint32_t machine, std::uint32_t instruction) {
  PIO0.at(pio::SM0_INSTR, machine, kStride).write(instruction);
}

/// Begins at the levels that the pins have now, so that they do not count as an edge.
void set_up(std::uint32_t machine, std::uint32_t first_pin) {
  using namespace pio_code;
  PIO0.at(pio::SM0_CLKDIV, machine, kStride).write(pio::SM0_CLKDIV_INT(1));
  PIO0.at(pio::SM0_EXECCTRL, machine, kStride)
      .write(pio::SM0_EXECCTRL_WRAP_BOTTOM(QuadratureProgram::kWrapBottom) |
             pio::SM0_EXECCTRL_WRAP_TOP(QuadratureProgram::kWrapTop));
  PIO0.at(pio::SM0_SHIFTCTRL, machine, kStride).write(0);  // to the left, nothing by itself
  PIO0.at(pio::SM0_PINCTRL, machine, kStride).write(pio::SM0_PINCTRL_IN_BASE(first_pin));
  execute(machine, kClear);
  execute(machine, move(To::x, From::isr));
  execute(machine, shift_in(From::pins, 2));
  execute(machine, move(To::y, From::isr));
  execute(machine, jump(If::always, QuadratureProgram::kRound));
}

/// The queue holds old counts, or is full and loses the new ones. What comes after it has been emptied is new.
std::int32_t newest(std::uint32_t machine, Bits level) {
  const Register queue = PIO0.at(pio::RXF0, machine, 4);
  for (std::uint32_t old = PIO0[pio::FLEVEL].get(level); old != 0; --old) static_cast<void>(queue.read());
  while (PIO0[pio::FLEVEL].get(level) == 0) {
  }
  return static_cast<std::int32_t>(queue.read());
}

}  // namespace

void Encoders::start() {
  wake(resets::RESET_PIO0.mask());
  apply(kEncoderPins);
  load_program();
  PIO0[pio::CTRL].write(0);
  set_up(0, gp::kLeftA);
  set_up(1, gp::kRightA);
  PIO0[pio::CTRL].write(pio::CTRL_SM_ENABLE(kBoth));
}

hal::EncoderCounts Encoders::read() noexcept {
  const std::int32_t left = newest(0, pio::FLEVEL_RX0), right = newest(1, pio::FLEVEL_RX1);
  return {left, right};
}

}  // namespace astro::rp2040
