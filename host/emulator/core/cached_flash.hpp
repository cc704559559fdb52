#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "host/emulator/core/memory.hpp"
#include "host/emulator/core/protection.hpp"

namespace astro::emulator {

/// Lines of the data cache that may hold something else than the flash does. The processor may fetch a line
/// ahead of any instruction that asks for it; one that it fetches while the flash works holds anything, and
/// stays until the firmware drops it.
class CachedFlash {
 public:
  /// The flash begins to work: all lines that the processor may keep.
  void distrust(const std::function<bool(std::uint32_t address)>& cached) {
    stale_.assign(Memory::kFlashBytes / kLine, false);
    for (std::uint32_t at = 0; at < Memory::kFlashBytes; at += Protection::kPage) {
      if (!cached(Memory::kFlash + at)) continue;
      const auto first = stale_.begin() + static_cast<std::ptrdiff_t>(at / kLine);
      std::fill(first, first + Protection::kPage / kLine, true);
    }
  }
  void drop(std::uint32_t address) {
    if (stale(address)) stale_[index(address)] = false;
  }
  /// A start of the chip: what a program begins with is its own to drop, and it does not read before.
  void clear() { stale_.clear(); }

  bool any() const { return !stale_.empty(); }
  bool stale(std::uint32_t address) const {
    return address >= Memory::kFlash && index(address) < stale_.size() && stale_[index(address)];
  }

 private:
  static constexpr std::uint32_t kLine = 32;
  static std::size_t index(std::uint32_t address) { return (address - Memory::kFlash) / kLine; }

  std::vector<bool> stale_;  // empty while the flash has not worked
};

}  // namespace astro::emulator
