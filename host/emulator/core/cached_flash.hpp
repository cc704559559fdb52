#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "host/emulator/core/memory.hpp"
#include "host/emulator/core/protection.hpp"

namespace astro::emulator {

/// Lines of the data cache that may differ from the flash. The processor may fetch a line before any
/// instruction needs it. A line that it fetches while the flash is busy has undefined content, and stays in
/// the cache until the firmware drops it.
class CachedFlash {
 public:
  /// The flash becomes busy: marks all lines that the processor may cache.
  void mark_stale(const std::function<bool(std::uint32_t address)>& cached) {
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
  /// At a start of the chip nothing is marked: the program drops stale lines itself before it reads.
  void clear() { stale_.clear(); }

  bool any() const { return !stale_.empty(); }
  bool stale(std::uint32_t address) const {
    return address >= Memory::kFlash && index(address) < stale_.size() && stale_[index(address)];
  }

 private:
  static constexpr std::uint32_t kLine = 32;
  static std::size_t index(std::uint32_t address) { return (address - Memory::kFlash) / kLine; }

  std::vector<bool> stale_;  // empty until the flash was busy
};

}  // namespace astro::emulator
