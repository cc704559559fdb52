#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace astro::rp2040 {

/// The sectors of the program flash that the robot writes, parameters first, at 0x101F'0000: above the largest program. The
/// boot ROM erases only the sectors that a new program takes.
///
/// The boot ROM sends the commands. While the flash is busy nothing can be read from it, which does no harm, because all
/// code and data are in SRAM: interrupts continue. The watchdog is fed before each command, not during one.
///
/// Misuse (outside the sectors, across a sector's end, unaligned) changes nothing and returns false.
///
/// Cost    erase 45 ms, 400 ms at most; each page of 256 bytes, or part of one, 0.4 ms, 3 ms at most.
class Flash {
 public:
  static constexpr std::uint32_t kSectors = 6;
  static constexpr std::uint32_t kSectorBytes = 4096;
  static constexpr std::uint32_t kProgramBytes =
      8;  // the rest of a page is programmed with ones, which change nothing
  static constexpr std::uint32_t kBytes = kSectors * kSectorBytes;

  bool erase(std::uint32_t sector) noexcept;
  bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept;

  /// Reads the mapped flash, whose cache is emptied after each command. 0xFF beyond the end.
  void read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept;

  /// The number that the flash was made with. Start-up only.
  static std::array<std::uint8_t, 8> serial_number() noexcept;
};

}  // namespace astro::rp2040
