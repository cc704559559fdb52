#include "common/base/little_endian.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace astro {
namespace {

TEST(LittleEndian, TheLeastSignificantByteComesFirstAndNothingElseIsWritten) {
  std::array<std::uint8_t, 10> bytes{};
  bytes.fill(0xEE);
  store_little_endian<std::uint64_t>(&bytes[1], 0x0102'0304'0506'0708);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 10>{0xEE, 8, 7, 6, 5, 4, 3, 2, 1, 0xEE}));
  store_little_endian<std::uint16_t>(&bytes[4], 0xA1B2);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 10>{0xEE, 8, 7, 6, 0xB2, 0xA1, 3, 2, 1, 0xEE}));
}

TEST(LittleEndian, WhatIsStoredIsLoadedAgain) {
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t value = std::uint64_t{1} << bit;
    std::array<std::uint8_t, 8> bytes{};
    store_little_endian(bytes.data(), value);
    EXPECT_EQ(load_little_endian<std::uint64_t>(bytes.data()), value);
    EXPECT_EQ(load_little_endian<std::uint32_t>(&bytes[bit / 8 < 4 ? 0 : 4]), value >> (bit < 32 ? 0 : 32));
  }
}

}  // namespace
}  // namespace astro
