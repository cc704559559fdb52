#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace astro {

/// A queue of bytes between one writer and one reader, which may interrupt each other. Bytes that do not fit
/// are not taken. kSize is a power of two.
template <std::size_t kSize>
class ByteRing {
  static_assert(kSize != 0 && (kSize & (kSize - 1)) == 0 && kSize <= 1U << 16);

 public:
  std::size_t size() const { return load(written_) - load(read_); }
  std::size_t room() const { return kSize - size(); }

  /// Returns how many were taken.
  std::size_t push(std::span<const std::uint8_t> bytes) {
    const std::uint32_t at = load(written_);
    const std::size_t count = std::min(bytes.size(), room());
    for (std::size_t i = 0; i < count; ++i) bytes_[(at + i) % kSize] = bytes[i];
    written_.store(at + static_cast<std::uint32_t>(count), std::memory_order_release);
    return count;
  }

  /// Returns how many were moved.
  std::size_t pop(std::span<std::uint8_t> into) {
    const std::uint32_t at = load(read_);
    const std::size_t count = std::min(into.size(), size());
    for (std::size_t i = 0; i < count; ++i) into[i] = bytes_[(at + i) % kSize];
    read_.store(at + static_cast<std::uint32_t>(count), std::memory_order_release);
    return count;
  }

  /// Call it as the reader, or while the reader cannot run.
  void clear() { read_.store(load(written_), std::memory_order_release); }

 private:
  using Count = std::atomic<std::uint32_t>;  // running totals; kSize divides 2^32
  static_assert(sizeof(Count) == 4, "a load or a store is one instruction; there is no other access");
  static std::uint32_t load(const Count& count) { return count.load(std::memory_order_acquire); }

  std::array<std::uint8_t, kSize> bytes_{};
  Count written_{0}, read_{0};
};

}  // namespace astro
