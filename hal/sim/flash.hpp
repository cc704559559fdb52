#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/sim/flash_faults.hpp"

namespace astro::sim {

/// NOR flash with everything that a store must survive: sectors are erased as a whole, programming only
/// clears bits, power fails after any byte, bits rot, cells are stuck and sectors fail (flash_faults.hpp).
///
/// Misuse (outside the flash, across a sector's end, unaligned) changes nothing, returns false and is
/// counted.
template <std::uint32_t Sectors, std::uint32_t SectorBytes, std::uint32_t ProgramBytes>
class SimulatedFlash {
 public:
  static constexpr std::uint32_t kSectors = Sectors;
  static constexpr std::uint32_t kSectorBytes = SectorBytes;
  static constexpr std::uint32_t kProgramBytes = ProgramBytes;
  static constexpr std::uint32_t kBytes = kSectors * kSectorBytes;

  /// `image` is a content() that was saved earlier. A shorter one is padded with erased bytes, a longer one
  /// is cut.
  explicit SimulatedFlash(std::span<const std::uint8_t> image = {}) : cells_(kBytes, 0xFF) {
    std::copy_n(image.begin(), std::min<std::size_t>(image.size(), kBytes), cells_.begin());
  }

  // As NorFlash (common/base) describes; also false if the power is off.

  bool erase(std::uint32_t sector) noexcept {
    if (sector >= kSectors) return misuse();
    if (!powered()) return false;
    ++erases_[sector];
    const auto cells = std::span(cells_).subspan(sector * kSectorBytes, kSectorBytes);
    faults_.erase(sector * kSectorBytes, cells);
    return powered() && std::ranges::all_of(cells, [](std::uint8_t cell) { return cell == 0xFF; });
  }

  bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept {
    const bool inside = offset <= kBytes && bytes.size() <= kBytes - offset;
    const bool aligned = offset % kProgramBytes == 0 && bytes.size() % kProgramBytes == 0;
    const bool one_sector = offset % kSectorBytes + bytes.size() <= kSectorBytes;
    if (!inside || !aligned || !one_sector) return misuse();
    if (!powered()) return false;
    const auto cells = std::span(cells_).subspan(offset, bytes.size());
    faults_.program(offset, cells, bytes);
    return powered() && std::ranges::equal(cells, bytes);
  }

  /// 0xFF beyond the end.
  void read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept {
    const std::size_t begin = std::min(offset, kBytes);
    const std::size_t inside = std::min<std::size_t>(into.size(), kBytes - begin);
    std::copy_n(cells_.begin() + static_cast<std::ptrdiff_t>(begin), inside, into.begin());
    std::ranges::fill(into.subspan(inside), std::uint8_t{0xFF});
  }

  // Faults; see FlashFaults.

  void cut_power_after(std::uint64_t bytes, Tear tear = Tear::sharp, std::uint64_t seed = 0) {
    faults_.cut_power_after(bytes, tear, seed);
  }
  void restore_power() { faults_.restore_power(); }
  bool powered() const { return faults_.powered(); }
  std::uint64_t bytes_worked() const { return faults_.bytes_worked(); }

  /// Bit rot: inverts the bits of `mask` in one byte.
  void rot(std::uint32_t at, std::uint8_t mask) {
    cells_[at] = faults_.held(at, static_cast<std::uint8_t>(cells_[at] ^ mask));
  }
  void stick(std::uint32_t at, std::uint8_t mask, bool level) {
    faults_.stick(at, mask, level);
    cells_[at] = faults_.held(at, cells_[at]);
  }
  void fail(std::uint32_t sector, FlashWork kind) { faults_.fail(sector * kSectorBytes, kSectorBytes, kind); }

  // What only the owner sees.

  std::span<const std::uint8_t, kBytes> content() const {
    return std::span<const std::uint8_t, kBytes>(cells_.data(), kBytes);
  }
  /// Restores saved bytes; counters and faults stay as they are.
  void put_back(std::uint32_t at, std::span<const std::uint8_t> bytes) {
    std::copy(bytes.begin(), bytes.end(), cells_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  /// Erase calls so far, including failed ones, because each wears the sector.
  std::uint32_t erases(std::uint32_t sector) const { return erases_[sector]; }
  int misuses() const { return misuses_; }

 private:
  bool misuse() {
    ++misuses_;
    return false;
  }

  std::vector<std::uint8_t> cells_;
  std::array<std::uint32_t, kSectors> erases_{};
  int misuses_ = 0;
  FlashFaults faults_;
};

/// The simulated board's flash. Its program unit is 4 bytes: serial NOR takes single bytes, but its
/// controllers move words, and a unit above 1 finds a store that does not set its padding.
using Flash = SimulatedFlash<6, 4096, 4>;

}  // namespace astro::sim
