#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "host/emulator/core/protection.hpp"

namespace astro::emulator {

/// What the chip has besides registers: 512 KB of FlexRAM in banks of 32 KB, each of them tightly coupled for
/// code or for data, or part of OCRAM after its fixed bytes; and the flash. All other addresses have no
/// memory.
class Memory {
 public:
  static constexpr std::uint32_t kItcm = 0x0000'0000, kDtcm = 0x2000'0000, kOcram = 0x2020'0000;
  static constexpr std::uint32_t kFlash = 0x6000'0000, kFlashBytes = 2 * 1024 * 1024;
  static constexpr std::uint32_t kBank = 32 * 1024, kFlexRam = 16 * kBank, kFixedOcram = 512 * 1024;

  /// How FlexRAM is divided, in bytes. The fuses of a new chip give 128 KB, 128 KB and 256 KB.
  struct Layout {
    std::uint32_t itcm = 4 * kBank, dtcm = 4 * kBank, ocram = 8 * kBank;
  };

  struct Range {
    std::uint32_t base;
    std::span<std::uint8_t> bytes;
    bool writable;
  };

  void set_layout(const Layout& layout) { layout_ = layout; }

  std::array<Range, 4> ranges() { return ranges(layout_); }
  /// The ranges with the largest size of any layout.
  std::array<Range, 4> largest() { return ranges({kFlexRam, kFlexRam, kFlexRam}); }

  /// The bytes at an address; empty if they are not all in one memory.
  std::span<std::uint8_t> at(std::uint32_t address, std::uint32_t bytes) {
    for (const Range& range : ranges())
      if (address >= range.base && address - range.base <= range.bytes.size() &&
          bytes <= range.bytes.size() - (address - range.base))
        return range.bytes.subspan(address - range.base, bytes);
    return {};
  }

  std::span<std::uint8_t> flash() { return flash_; }

 private:
  std::array<Range, 4> ranges(const Layout& layout) {
    return {{{kItcm, std::span(itcm_).first(layout.itcm), true},
             {kDtcm, std::span(dtcm_).first(layout.dtcm), true},
             {kOcram, std::span(ocram_).first(kFixedOcram + layout.ocram), true},
             {kFlash, flash_, false}}};
  }

  std::vector<std::uint8_t> itcm_ = std::vector<std::uint8_t>(kFlexRam);
  std::vector<std::uint8_t> dtcm_ = std::vector<std::uint8_t>(kFlexRam);
  std::vector<std::uint8_t> ocram_ = std::vector<std::uint8_t>(kFixedOcram + kFlexRam);
  std::vector<std::uint8_t> flash_ = std::vector<std::uint8_t>(kFlashBytes, 0xFF);
  Layout layout_;
};

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
