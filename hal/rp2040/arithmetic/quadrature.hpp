#pragma once

#include <array>
#include <cstdint>

namespace astro::rp2040 {

/// The few instructions of a PIO state machine that the decoder is made of.
///
/// Source  RP2040 data sheet, 3.4: the major opcode in the upper three bits; no delays, no side-set.
namespace pio_code {

enum class If : std::uint32_t { always = 0, x_was_not_zero = 2 };
enum class From : std::uint32_t { pins = 0, x = 1, y = 2, isr = 6 };
enum class To : std::uint32_t { x = 1, y = 2, pc = 5, isr = 6 };

/// `x_was_not_zero` also decrements X, whether it jumps or not.
constexpr std::uint32_t jump(If condition, std::uint32_t to) {
  return static_cast<std::uint32_t>(condition) << 5 | to;
}
/// Shifts ISR left by `bits` and takes them from `from`.
constexpr std::uint32_t shift_in(From from, std::uint32_t bits) {
  return 2U << 13 | static_cast<std::uint32_t>(from) << 5 | bits;
}
/// Moves ISR into the queue, or loses it if the queue is full; ISR is zero afterwards.
inline constexpr std::uint32_t kPushOrLose = 4U << 13;
constexpr std::uint32_t move(To to, From from) {
  return 5U << 13 | static_cast<std::uint32_t>(to) << 5 | static_cast<std::uint32_t>(from);
}
inline constexpr std::uint32_t kClear = 5U << 13 | 6U << 5 | 3U;  // ISR = 0
constexpr std::uint32_t move_inverted(To to, From from) { return move(to, from) | 1U << 3; }

}  // namespace pio_code

/// A quadrature decoder as a program of a PIO state machine: X is the count, Y the levels of the two pins (A in bit 0, B
/// in bit 1) before. Each round publishes the count, takes the levels, and jumps by the old levels times four plus the new
/// ones into a table: nothing, one more, or one less. If both have changed nobody knows the direction, and nothing is
/// counted.
///
/// The machine can only count down; one more is one less of the complement.
///
/// Cost    10 cycles a round at most: 12.5 million counts a second. A round of 7 where nothing moves.
struct QuadratureProgram {
  static constexpr std::uint32_t kTable = 0, kMinus = 16, kRound = 17, kPlus = 23, kLength = 26;
  static constexpr std::uint32_t kWrapBottom = kRound, kWrapTop = kLength - 1;

  std::array<std::uint16_t, kLength> code{};

  constexpr QuadratureProgram() {
    using namespace pio_code;
    for (std::uint32_t before = 0; before < 4; ++before)
      for (std::uint32_t now = 0; now < 4; ++now)
        put(kTable + 4 * before + now, jump(If::always, target(before, now)));
    put(kMinus, jump(If::x_was_not_zero, kRound));
    put(kRound + 0, move(To::isr, From::x));
    put(kRound + 1, kPushOrLose);
    put(kRound + 2, shift_in(From::y, 2));
    put(kRound + 3, shift_in(From::pins, 2));
    put(kRound + 4, move(To::y, From::isr));  // the upper two bits are the levels before and shift out
    put(kRound + 5, move(To::pc, From::isr));
    put(kPlus + 0, move_inverted(To::x, From::x));
    put(kPlus + 1, jump(If::x_was_not_zero, kPlus + 2));
    put(kPlus + 2, move_inverted(To::x, From::x));  // then it wraps to kRound
  }

  /// A leads B in the positive direction: 00, 01, 11, 10, as BA.
  static constexpr std::uint32_t target(std::uint32_t before, std::uint32_t now) {
    const std::uint32_t changed = before ^ now;
    if (changed == 0 || changed == 3) return kRound;
    const bool a_changed = changed == 1;
    const bool levels_equal = (now & 1) == now >> 1;
    return a_changed == levels_equal ? kMinus : kPlus;
  }

 private:
  constexpr void put(std::uint32_t at, std::uint32_t instruction) {
    code[at] = static_cast<std::uint16_t>(instruction);
  }
};

inline constexpr QuadratureProgram kQuadrature{};
static_assert(QuadratureProgram::kLength <= 32);

}  // namespace astro::rp2040
