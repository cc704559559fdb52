#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace astro::sim {

/// What a power cut leaves of the bytes that were not finished yet.
///   sharp   the old content: work stopped between two bytes
///   torn    each bit either old or new, by a fixed hash: work was going on in all of them
enum class Tear : std::uint8_t { sharp, torn };

/// NOR flash with the habits that a parameter store must survive: sectors erase as a whole, programming only
/// clears bits, and power fails after any byte.
///
/// kProgramBytes is 4: serial NOR takes single bytes, but its controllers move words, and a granularity above
/// 1 catches a store that leaves padding to chance.
///
/// Misuse (outside the part, across a sector's end, unaligned) changes nothing and returns false.
class Flash {
 public:
  static constexpr std::uint32_t kSectors = 4;
  static constexpr std::uint32_t kSectorBytes = 4096;
  static constexpr std::uint32_t kProgramBytes = 4;
  static constexpr std::uint32_t kBytes = kSectors * kSectorBytes;

  /// `image` is a content() saved earlier; shorter ones are filled up with erased bytes, longer ones cut.
  explicit Flash(std::span<const std::uint8_t> image = {});

  bool erase(std::uint32_t sector) noexcept;
  bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept;
  void read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept;  // 0xFF beyond the end

  /// Power fails when `bytes` more bytes have been erased or programmed: the call that reaches that number
  /// returns false, and so does every later one, changing nothing, until restore_power().
  void cut_power_after(std::uint64_t bytes, Tear tear = Tear::sharp);
  void restore_power();
  bool powered() const { return powered_; }

  /// Bytes erased or programmed so far; the range of interesting arguments for cut_power_after.
  std::uint64_t bytes_worked() const { return worked_; }

  std::span<const std::uint8_t, kBytes> content() const { return content_; }

 private:
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  void work(std::uint32_t at, std::uint8_t target);

  std::array<std::uint8_t, kBytes> content_;
  std::uint64_t worked_ = 0;
  std::uint64_t cut_at_ = kNever;
  Tear tear_ = Tear::sharp;
  bool powered_ = true;
};

}  // namespace astro::sim
