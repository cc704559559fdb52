#pragma once

#include <cstdint>

namespace astro::teensy40 {

/// Instructions for the flash, as the FlexSPI controller's look-up table holds them: two in a word, the lower
/// half first.
namespace lut {

enum class Op : std::uint32_t { stop = 0, command = 1, address = 2, write = 8, read = 9 };
enum class Lines : std::uint32_t { one = 0, four = 2 };

constexpr std::uint32_t step(Op op, std::uint32_t operand, Lines lines = Lines::one) {
  return static_cast<std::uint32_t>(op) << 10 | static_cast<std::uint32_t>(lines) << 8 | operand;
}
constexpr std::uint32_t pair(std::uint32_t first, std::uint32_t second = step(Op::stop, 0)) {
  return first | second << 16;
}

}  // namespace lut

/// One sequence: two words do for every command here.
struct FlashCommand {
  std::uint32_t first = 0, second = 0;
  friend constexpr bool operator==(const FlashCommand&, const FlashCommand&) = default;
};

/// The commands of the W25Q16JV.
inline constexpr FlashCommand kWriteEnable{lut::pair(lut::step(lut::Op::command, 0x06))};
inline constexpr FlashCommand kReadStatus{
    lut::pair(lut::step(lut::Op::command, 0x05), lut::step(lut::Op::read, 1))};
inline constexpr FlashCommand kEraseSector{
    lut::pair(lut::step(lut::Op::command, 0x20), lut::step(lut::Op::address, 24))};
inline constexpr FlashCommand kProgramPage{
    // the data on four lines
    lut::pair(lut::step(lut::Op::command, 0x32), lut::step(lut::Op::address, 24)),
    lut::pair(lut::step(lut::Op::write, 1, lut::Lines::four))};

}  // namespace astro::teensy40
