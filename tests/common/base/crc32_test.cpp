#include "common/base/crc32.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace astro {
namespace {

std::uint32_t crc_of(std::string_view text) {
  return crc32(std::vector<std::uint8_t>(text.begin(), text.end()));
}

TEST(Crc32, GivesThePublishedCheckValues) {
  EXPECT_EQ(crc_of("123456789"), 0xCBF43926U);  // catalogue of parametrised CRC algorithms, CRC-32/ISO-HDLC
  EXPECT_EQ(crc_of(""), 0x00000000U);
  EXPECT_EQ(crc_of("a"), 0xE8B7BE43U);  // RFC 1952 and zlib agree on these, known from many test suites
  EXPECT_EQ(crc_of("abc"), 0x352441C2U);
  EXPECT_EQ(crc_of("The quick brown fox jumps over the lazy dog"), 0x414FA339U);
  // Bit order and preset in one: 32 bytes of zeros and of ones, as in zlib.
  EXPECT_EQ(crc32(std::vector<std::uint8_t>(32, 0x00)), 0x190A55ADU);
  EXPECT_EQ(crc32(std::vector<std::uint8_t>(32, 0xFF)), 0xFF6CAB0BU);
}

TEST(Crc32, IsKnownAtCompileTime) {
  constexpr std::uint8_t kDigits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  static_assert(crc32<1>(kDigits) == 0xCBF43926U && crc32<4>(kDigits) == 0xCBF43926U);
}

/// The definition, one bit at a time.
std::uint32_t crc_by_definition(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const std::uint8_t byte : bytes) {
    for (int bit = 0; bit < 8; ++bit) {
      const bool feedback = ((crc ^ static_cast<std::uint32_t>(byte >> bit)) & 1U) != 0;
      crc = (crc >> 1) ^ (feedback ? 0xEDB88320U : 0U);
    }
  }
  return ~crc;
}

RC_GTEST_PROP(Crc32, IsTheDivisionBitByBitInSlicesOrNot, (std::vector<std::uint8_t> bytes)) {
  RC_ASSERT(crc32<4>(bytes) == crc_by_definition(bytes));
  RC_ASSERT(crc32<1>(bytes) == crc_by_definition(bytes));
}

RC_GTEST_PROP(Crc32, OfTwoPartsOneAfterTheOtherIsTheCrcOfTheWhole, (std::vector<std::uint8_t> bytes)) {
  const auto cut = *rc::gen::inRange<std::size_t>(0, bytes.size() + 1);
  const std::span<const std::uint8_t> all(bytes);
  RC_ASSERT(crc32(all.subspan(cut), crc32(all.first(cut))) == crc32(all));
}

RC_GTEST_PROP(Crc32, OfAMessageWithItsOwnCrcBehindIsTheResidue, (std::vector<std::uint8_t> bytes)) {
  const std::uint32_t crc = crc32(bytes);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(crc >> shift));
  RC_ASSERT(crc32(bytes) == ~0xDEBB20E3U);  // the catalogue's residue, here after the final inversion
}

}  // namespace
}  // namespace astro
