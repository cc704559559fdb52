#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace astro::emulator {

/// What the chip has besides registers. The tightly coupled memories have the size that the firmware asks the
/// FlexRAM for (chip/iomuxc_gpr.hpp holds it to that); around them lies nothing.
class Memory {
 public:
  static constexpr std::uint32_t kItcm = 0x0000'0000, kItcmBytes = 128 * 1024;
  static constexpr std::uint32_t kDtcm = 0x2000'0000, kDtcmBytes = 384 * 1024;
  static constexpr std::uint32_t kOcram = 0x2020'0000, kOcramBytes = 512 * 1024;
  static constexpr std::uint32_t kFlash = 0x6000'0000, kFlashBytes = 2 * 1024 * 1024;

  struct Range {
    std::uint32_t base;
    std::span<std::uint8_t> bytes;
    bool writable;
  };

  Memory() : itcm_(kItcmBytes), dtcm_(kDtcmBytes), ocram_(kOcramBytes), flash_(kFlashBytes, 0xFF) {}

  std::array<Range, 4> ranges() {
    return {{{kItcm, itcm_, true}, {kDtcm, dtcm_, true}, {kOcram, ocram_, true}, {kFlash, flash_, false}}};
  }

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
  std::vector<std::uint8_t> itcm_, dtcm_, ocram_, flash_;
};

}  // namespace astro::emulator
