#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace astro::support {

/// What a power cut tears: the byte that is being worked on, or the whole block (program unit, sector) at
/// once.
enum class Torn { byte, block };

/// NOR flash for tests: erase sets bytes to 0xFF and program clears bits, one byte after the other; a program
/// that would have to set a bit leaves it at 0. One byte worked on is one step. When the power is cut, what
/// is under way is left with a random mixture of old and new bits and everything after it does nothing and
/// returns false, until power_on(). Same seed, same mixtures.
template <std::uint32_t Sectors, std::uint32_t SectorBytes, std::uint32_t ProgramBytes>
class NorFlash {
 public:
  static constexpr std::uint32_t kSectors = Sectors;
  static constexpr std::uint32_t kSectorBytes = SectorBytes;
  static constexpr std::uint32_t kProgramBytes = ProgramBytes;

  explicit NorFlash(std::uint32_t seed = 1)
      : random_(seed), cells_(std::size_t{kSectors} * kSectorBytes, 0xFF) {}

  bool erase(std::uint32_t sector) noexcept {
    if (sector >= kSectors) return misuse();
    const std::vector<std::uint8_t> blank(kSectorBytes, 0xFF);
    if (powered_) ++erases_[sector];
    return work(sector * kSectorBytes, blank, kSectorBytes);
  }

  bool program(std::uint32_t at, std::span<const std::uint8_t> bytes) noexcept {
    const std::uint32_t last = at + static_cast<std::uint32_t>(bytes.size()) - 1;
    if (bytes.empty() || at % kProgramBytes != 0 || bytes.size() % kProgramBytes != 0 ||
        last >= cells_.size() || at / kSectorBytes != last / kSectorBytes) {
      return misuse();
    }
    std::vector<std::uint8_t> target(bytes.begin(), bytes.end());
    for (std::size_t i = 0; i < target.size(); ++i) target[i] &= cells_[at + i];
    return work(at, target, kProgramBytes) && std::ranges::equal(target, bytes);
  }

  void read(std::uint32_t at, std::span<std::uint8_t> into) noexcept {
    if (at + into.size() > cells_.size()) {
      misuse();
    } else {
      std::copy_n(cells_.begin() + at, into.size(), into.begin());
    }
  }

  /// The power goes in the middle of step number `steps` from now, counted from 0.
  void cut_after(std::uint64_t steps, Torn torn) {
    cut_at_ = steps_ + steps;
    cut_armed_ = true;
    torn_ = torn;
  }
  void power_on() {
    powered_ = true;
    cut_armed_ = false;
  }
  bool powered() const { return powered_; }
  void reseed(std::uint32_t seed) { random_.seed(seed); }

  void wear_out(std::uint32_t sector) { worn_[sector] = true; }  // its cells no longer change
  void flip_bits(std::uint32_t at, std::uint8_t mask) { cells_[at] ^= mask; }
  std::span<const std::uint8_t> cells() const { return cells_; }
  std::uint64_t steps() const { return steps_; }
  std::uint32_t erases(std::uint32_t sector) const { return erases_[sector]; }
  /// Calls that break the contract of the flash: out of range, not aligned, across sectors.
  int misuses() const { return misuses_; }

 private:
  bool misuse() {
    ++misuses_;
    return false;
  }

  bool work(std::uint32_t at, std::span<const std::uint8_t> target, std::uint32_t block) {
    for (std::uint32_t i = 0; i < target.size() && powered_; ++i) {
      if (cut_armed_ && steps_ == cut_at_) {
        powered_ = false;
        const std::uint32_t first = torn_ == Torn::byte ? i : i / block * block;
        const std::uint32_t count = torn_ == Torn::byte ? 1 : block;
        for (std::uint32_t k = first; k < first + count; ++k) tear(at + k, target[k]);
        return false;
      }
      if (!worn_[at / kSectorBytes]) cells_[at + i] = target[i];
      ++steps_;
    }
    return powered_ && std::equal(target.begin(), target.end(), cells_.begin() + at);
  }

  void tear(std::uint32_t at, std::uint8_t target) {
    const auto mask = static_cast<std::uint8_t>(random_());
    cells_[at] = static_cast<std::uint8_t>((cells_[at] & mask) | (target & ~mask));
  }

  std::mt19937 random_;
  std::vector<std::uint8_t> cells_;
  std::array<std::uint32_t, kSectors> erases_{};
  std::array<bool, kSectors> worn_{};
  bool powered_ = true;
  bool cut_armed_ = false;
  Torn torn_ = Torn::byte;
  std::uint64_t cut_at_ = 0;
  std::uint64_t steps_ = 0;
  int misuses_ = 0;
};

}  // namespace astro::support
