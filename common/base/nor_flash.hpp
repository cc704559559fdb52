#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace astro {

/// NOR flash: `kSectors` sectors of `kSectorBytes`.
///
///   erase(sector)            every byte of the sector becomes 0xFF
///   program(offset, bytes)   clears bits: the result is old AND new. `offset` and the size are multiples of
///                            kProgramBytes, and all bytes lie in one sector.
///   read(offset, into)       copies bytes; always allowed
///
/// Erase and program return false if a read-back differs; code that needs to be sure reads back itself. A
/// power cut leaves any mixture of old and new bits in the bytes that are being written, and changes no
/// others.
template <class T>
concept NorFlash = requires(T& flash, std::uint32_t at, std::span<std::uint8_t> into,
                            std::span<const std::uint8_t> bytes) {
  { T::kSectors } -> std::convertible_to<std::uint32_t>;
  { T::kSectorBytes } -> std::convertible_to<std::uint32_t>;
  { T::kProgramBytes } -> std::convertible_to<std::uint32_t>;
  { flash.erase(at) }
  noexcept->std::same_as<bool>;
  { flash.program(at, bytes) }
  noexcept->std::same_as<bool>;
  { flash.read(at, into) }
  noexcept->std::same_as<void>;
};

/// Every byte reads as if erased.
constexpr bool is_blank(std::span<const std::uint8_t> bytes) {
  return std::ranges::all_of(bytes, [](std::uint8_t byte) { return byte == 0xFF; });
}

/// `Count` sectors of a flash, from sector `First` on, as a flash of their own: whoever gets one cannot reach
/// the sectors of another.
///
/// Erasing or programming outside the region changes nothing and returns false; reading gives 0xFF there.
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
