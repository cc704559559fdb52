#include "common/safety/fault_log.hpp"

#include <gtest/gtest.h>

#include "tests/common/safety/fault_log_on.hpp"

namespace astro {
namespace {

using support::append;
using support::circumstances;
using support::entries;

template <class Flash>
using FaultLogOn = support::FaultLogOn<Flash>;
TYPED_TEST_SUITE(FaultLogOn, support::LogGeometries);

TEST(FaultRecord, GivesBackWhatWentIn) {
  LoggedFault entry{0xFFFF'FFFE, 0x8000'0001, circumstances(77)};
  entry.was.time_us = 0xFEDC'BA98'7654'3210;
  entry.was.battery_mv = -1;
  entry.was.fault = static_cast<Fault>(200);
  EXPECT_EQ(decode(encode(entry)), entry);
}

TEST(FaultRecord, NoticesEveryFlippedBit) {
  const FaultRecord good = encode({1, 2, circumstances(3)});
  for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
    FaultRecord bad = good;
    bad[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    EXPECT_FALSE(decode(bad)) << "bit " << bit;
  }
  FaultRecord blank;
  blank.fill(0xFF);
  EXPECT_FALSE(decode(blank));
  EXPECT_FALSE(decode(FaultRecord{}));
}

TEST(FaultRecord, LiesInFlashAsItsHeaderSays) {
  const FaultRecord record = encode({0x04030201, 9, {.fault = Fault::stall, .mode = 2}});
  const std::array<std::uint8_t, 12> begin{'A', 'S', 'F', 1, 7, 2, 0, 0, 1, 2, 3, 4};
  EXPECT_TRUE(std::ranges::equal(begin, std::span(record).first(12)));
}

TYPED_TEST(FaultLogOn, FreshFlashHoldsNone) { EXPECT_TRUE(entries(this->flash).empty()); }

TYPED_TEST(FaultLogOn, EntriesComeBackNewestFirstWhateverTheirNumber) {
  const std::uint32_t slots = this->kSlots, all = slots * TypeParam::kSectors;
  for (std::uint32_t n = 1; n <= 3 * all; ++n) {
    ASSERT_TRUE(append(this->flash, n, n / 10));
    const auto held = entries(this->flash);
    ASSERT_GE(held.size(), std::min(n, all - slots + 1));
    ASSERT_LE(held.size(), all);
    for (std::uint32_t i = 0; i < held.size(); ++i)
      ASSERT_EQ(held[i], (LoggedFault{n - i, (n - i) / 10, circumstances(n - i)}));
  }
}

TYPED_TEST(FaultLogOn, EachEntryIsFoundByItsIndex) {
  const FaultLog<TypeParam> log(this->flash);
  EXPECT_FALSE(log.get(0));
  for (std::uint32_t n = 1; n <= this->kSlots * TypeParam::kSectors + 1; ++n)
    ASSERT_TRUE(append(this->flash, n));
  const auto held = entries(this->flash);
  for (std::uint32_t i = 0; i < held.size(); ++i) EXPECT_EQ(log.get(i), held[i]);
  EXPECT_FALSE(log.get(static_cast<std::uint32_t>(held.size())));
}

TYPED_TEST(FaultLogOn, ASectorIsErasedOnlyWhenAllAreFull) {
  const std::uint32_t all = this->kSlots * TypeParam::kSectors;
  for (std::uint32_t n = 1; n <= 10 * all; ++n) ASSERT_TRUE(append(this->flash, n));
  for (std::uint32_t sector = 0; sector < TypeParam::kSectors; ++sector)
    EXPECT_EQ(this->flash.erases(sector), 10U);
}

TYPED_TEST(FaultLogOn, NewestStaysNewestWhileTheNumberWraps) {
  const FaultRecord last = encode({0xFFFF'FFFA, 3, circumstances(1)});
  std::vector<std::uint8_t> bytes(FaultLog<TypeParam>::kSlotBytes, 0xFF);
  std::ranges::copy(last, bytes.begin());
  ASSERT_TRUE(this->flash.program(0, bytes));
  const std::uint32_t all = this->kSlots * TypeParam::kSectors;
  for (std::uint32_t n = 1; n <= 2 * all; ++n) {
    ASSERT_TRUE(append(this->flash, n));
    const auto held = entries(this->flash);
    ASSERT_EQ(held.front().number, 0xFFFF'FFFA + n);
    ASSERT_EQ(held.front().was, circumstances(n));
    ASSERT_GE(held.size(), std::min(n + 1, all - this->kSlots + 1));
  }
}

}  // namespace
}  // namespace astro
