#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace astro {

/// CRC-32 as in Ethernet, zlib and PNG ("CRC-32/ISO-HDLC"): polynomial 0x04C11DB7 reflected, start and final
/// inversion 0xFFFFFFFF. Of "123456789": 0xCBF43926. Finds every burst of up to 32 bits.
///
///   Crc32 crc;  crc.add(header);  crc.add(payload);  crc.value()   is the CRC of both in a row
///
/// Cost    one table look-up per byte; 1 KiB of constants, 4 bytes of state.
class Crc32 {
 public:
  constexpr void add(std::uint8_t byte) { state_ = (state_ >> 8) ^ kTable[(state_ ^ byte) & 0xFFU]; }
  constexpr void add(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) add(byte);
  }
  constexpr std::uint32_t value() const { return ~state_; }

 private:
  static constexpr std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
      std::uint32_t remainder = byte;
      for (int bit = 0; bit < 8; ++bit) {
        remainder = (remainder >> 1) ^ ((remainder & 1U) != 0 ? 0xEDB88320U : 0U);
      }
      table[byte] = remainder;
    }
    return table;
  }();

  std::uint32_t state_ = 0xFFFF'FFFFU;
};

/// The CRC of one piece.
constexpr std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

static_assert(crc32(std::array<std::uint8_t, 9>{'1', '2', '3', '4', '5', '6', '7', '8', '9'}) == 0xCBF4'3926U,
              "the check value of the CRC catalogue");

}  // namespace astro
