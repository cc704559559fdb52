#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace astro::mock {

/// NOR flash in RAM. Its program unit of 8 bytes and its four sectors differ from the simulator's on purpose:
/// code that assumes either fails on one of the two boards.
///
/// Misuse (outside the flash, across a sector's end, unaligned) changes nothing and returns false.
struct Flash {
  static constexpr std::uint32_t kSectors = 4;
  static constexpr std::uint32_t kSectorBytes = 4096;
  static constexpr std::uint32_t kProgramBytes = 8;

  std::array<std::uint8_t, std::size_t{kSectors}* kSectorBytes> content = erased();
  bool broken = false;           // true: erase and program change nothing and return false
  int erases = 0, programs = 0;  // calls so far

  bool erase(std::uint32_t sector) noexcept {
    ++erases;
    if (broken || sector >= kSectors) return false;
    std::fill_n(content.begin() + std::size_t{sector} * kSectorBytes, kSectorBytes, std::uint8_t{0xFF});
    return true;
  }

  bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept {
    ++programs;
    const bool inside = offset < content.size() && offset % kSectorBytes + bytes.size() <= kSectorBytes;
    const bool aligned = offset % kProgramBytes == 0 && bytes.size() % kProgramBytes == 0;
    if (broken || !inside || !aligned) return false;
    const auto place = content.begin() + offset;
    std::transform(bytes.begin(), bytes.end(), place, place, [](std::uint8_t wanted, std::uint8_t old) {
      return static_cast<std::uint8_t>(old & wanted);
    });
    return std::equal(bytes.begin(), bytes.end(), place);
  }

  /// 0xFF beyond the end.
  void read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept {
    std::fill(into.begin(), into.end(), std::uint8_t{0xFF});
    if (offset >= content.size()) return;
    std::copy_n(content.begin() + offset, std::min(into.size(), content.size() - offset), into.begin());
  }

 private:
  static constexpr std::array<std::uint8_t, std::size_t{kSectors} * kSectorBytes> erased() {
    std::array<std::uint8_t, std::size_t{kSectors} * kSectorBytes> all;
    all.fill(0xFF);
    return all;
  }
};

}  // namespace astro::mock
