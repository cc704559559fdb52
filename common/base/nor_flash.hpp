#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace astro {

/// NOR flash in sectors: erase makes every byte of one sector 0xFF, program clears bits in whole units of
/// kProgramBytes within one sector, a power cut leaves any mixture of old and new bits in the bytes under
/// way. Both return false if the flash does not read back what it should; nobody has to believe them.
template <class T>
concept NorFlash = requires(T& flash, std::uint32_t at, std::span<std::uint8_t> into,
                            std::span<const std::uint8_t> bytes) {
  { T::kSectors } -> std::convertible_to<std::uint32_t>;
  { T::kSectorBytes } -> std::convertible_to<std::uint32_t>;
  { T::kProgramBytes } -> std::convertible_to<std::uint32_t>;
  { flash.erase(at) } -> std::same_as<bool>;
  { flash.program(at, bytes) } -> std::same_as<bool>;
  { flash.read(at, into) } -> std::same_as<void>;
};

/// `Count` sectors of a flash, from sector `First` on, as a flash of their own: nobody who is given one
/// reaches another's sectors.
///
/// Misuse (outside the region) changes nothing and returns false; reads give 0xFF there.
template <NorFlash Flash, std::uint32_t First, std::uint32_t Count>
class FlashRegion {
 public:
  static constexpr std::uint32_t kSectors = Count;
  static constexpr std::uint32_t kSectorBytes = Flash::kSectorBytes;
  static constexpr std::uint32_t kProgramBytes = Flash::kProgramBytes;
  static_assert(Count > 0 && First + Count <= Flash::kSectors);

  explicit FlashRegion(Flash& flash) : flash_(flash) {}

  bool erase(std::uint32_t sector) noexcept { return sector < kSectors && flash_.erase(First + sector); }
  bool program(std::uint32_t at, std::span<const std::uint8_t> bytes) noexcept {
    return at < kBytes && flash_.program(kBegin + at, bytes);
  }
  void read(std::uint32_t at, std::span<std::uint8_t> into) noexcept {
    const std::size_t inside = at < kBytes ? std::min<std::size_t>(into.size(), kBytes - at) : 0;
    flash_.read(kBegin + at, into.first(inside));
    for (std::uint8_t& byte : into.subspan(inside)) byte = 0xFF;
  }

 private:
  static constexpr std::uint32_t kBegin = First * kSectorBytes, kBytes = kSectors * kSectorBytes;

  Flash& flash_;
};

}  // namespace astro
