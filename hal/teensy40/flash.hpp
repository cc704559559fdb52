#pragma once

#include <cstdint>
#include <span>

namespace astro::teensy40 {

/// The sectors of the program flash that the robot writes, parameters first, at 0x601F'0000: above the
/// largest program, where the boot loader does not erase, and far below 0x601F'F000, where it keeps a program
/// of its own.
///
/// Misuse (outside the sectors, across a sector's end, unaligned) changes nothing and returns false.
///
/// Cost    erase 45 ms, 400 ms at most; a page of 256 bytes 0.4 ms, 3 ms at most. Interrupts go on.
class Flash {
 public:
  static constexpr std::uint32_t kSectors = 6;
  static constexpr std::uint32_t kSectorBytes = 4096;
  static constexpr std::uint32_t kProgramBytes = 8;  // what the controller's queue takes at a time
  static constexpr std::uint32_t kBytes = kSectors * kSectorBytes;

  /// A flash that is still busy after a second is taken to be broken. Both feed the watchdog while they wait.
  bool erase(std::uint32_t sector) noexcept;
  bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept;

  /// From the mapped flash, which erase and program keep true: the way the chip boots, and no waiting for a
  /// command's queue. Beyond the end: 0xFF.
  void read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept;
};

}  // namespace astro::teensy40
