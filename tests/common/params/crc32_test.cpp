#include "common/base/crc32.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <string_view>
#include <vector>

namespace astro {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

TEST(Crc32, AgreesWithPublishedValues) {
  EXPECT_EQ(crc32(bytes_of("123456789")), 0xCBF43926U);  // CRC catalogue, CRC-32/ISO-HDLC
  EXPECT_EQ(crc32(bytes_of("")), 0U);
  EXPECT_EQ(crc32(bytes_of("The quick brown fox jumps over the lazy dog")), 0x414FA339U);  // zlib's crc32()
}

RC_GTEST_PROP(Crc32, OfPiecesInARowIsTheCrcOfTheWhole, (std::vector<std::uint8_t> bytes)) {
  const auto cut = *rc::gen::inRange<std::size_t>(0, bytes.size() + 1);
  Crc32 pieces;
  pieces.add(std::span(bytes).first(cut));
  pieces.add(std::span(bytes).subspan(cut));
  RC_ASSERT(pieces.value() == crc32(bytes));
}

TEST(Crc32, FindsEveryFlipOfOneOrTwoBitsInARecordSizedBlock) {
  std::vector<std::uint8_t> block(300);
  for (std::size_t i = 0; i < block.size(); ++i) block[i] = static_cast<std::uint8_t>(i * 37);
  const std::uint32_t whole = crc32(block);
  const auto flip = [&](std::size_t bit) { block[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8)); };
  for (std::size_t first = 0; first < block.size() * 8; ++first) {
    flip(first);
    ASSERT_NE(crc32(block), whole) << "bit " << first;
    const std::size_t second = (first * 7 + 13) % (block.size() * 8);
    if (second != first) {
      flip(second);
      ASSERT_NE(crc32(block), whole) << "bits " << first << " and " << second;
      flip(second);
    }
    flip(first);
  }
}

}  // namespace
}  // namespace astro
