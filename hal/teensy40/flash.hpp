#pragma once

#include <cstdint>
#include <span>

namespace astro::teensy40 {

/// The sectors of the program flash that the robot writes, parameters first, at 0x601F'0000. That is above
/// the largest program, where the boot loader does not erase, and far below 0x601F'F000, where the boot
/// loader keeps a program of its own.
///
/// Misuse (outside the sectors, across a sector's end, unaligned) changes nothing and returns false.
///
/// Cost    erase 45 ms, 400 ms at most; a page of 256 bytes 0.4 ms, 3 ms at most. Interrupts continue.
class Flash {
 public:
  static constexpr std::uint32_t kSectors = 6;
  static constexpr std::uint32_t kSectorBytes = 4096;
  static constexpr std::uint32_t kProgramBytes = 8;  // what the controller's queue takes at a time
  static constexpr std::uint32_t kBytes = kSectors * kSectorBytes;

  /// Both fail if the flash is still busy after a second, and feed the watchdog while they wait.
  bool erase(std::uint32_t sector) noexcept;
  bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept;

  /// Reads the mapped flash, without commands; erase and program keep the mapping up to date. 0xFF beyond the
  /// end.
  void read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept;
};

}  // namespace astro::teensy40
