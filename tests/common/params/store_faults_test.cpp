#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "tests/common/params/store_on.hpp"

/// Rotten bits, cells that stick, sectors that fail: the newest set that can be read is found, and what a
/// commit has promised is kept.
namespace astro {
namespace {

using sim::FlashWork;
using support::commit;
using support::load;
using support::random_valid_set;

template <class Flash>
using FaultyStoreOn = support::StoreOn<Flash>;
TYPED_TEST_SUITE(FaultyStoreOn, support::Geometries);

TYPED_TEST(FaultyStoreOn, BitRotInTheNewestRecordFallsBackToTheOneBefore) {
  const ParameterSet older = random_valid_set(this->random);
  const ParameterSet newer = random_valid_set(this->random);
  ASSERT_TRUE(commit(this->flash, older));
  const std::vector<std::uint8_t> before(this->flash.content().begin(), this->flash.content().end());
  ASSERT_TRUE(commit(this->flash, newer));
  EXPECT_FALSE(load(this->flash).outrun);
  int said = 0, rotten = 0;
  for (std::uint32_t at = 0; at < before.size(); ++at) {
    if (this->flash.content()[at] == before[at]) continue;  // not a byte of the newest record
    const auto mask = static_cast<std::uint8_t>(1U << (at % 8));
    this->flash.rot(at, mask);
    const Load loaded = load(this->flash);
    ASSERT_EQ(loaded.status, LoadStatus::loaded);
    ASSERT_EQ(loaded.set, older) << "rot at " << at;
    ASSERT_EQ(loaded.skipped, 1U) << "rot at " << at;
    said += loaded.outrun ? 1 : 0;
    ++rotten;
    this->flash.rot(at, mask);
  }
  EXPECT_EQ(load(this->flash).set, newer);
  EXPECT_GE(said, rotten - 5)
      << "all but rot in the magic, and a bit less in the sequence, is of a newer set";
}

TYPED_TEST(FaultyStoreOn, CommitAfterBitRotWinsOverTheRottenRecord) {
  const ParameterSet first = random_valid_set(this->random), third = random_valid_set(this->random);
  ASSERT_TRUE(commit(this->flash, first));
  ASSERT_TRUE(commit(this->flash, random_valid_set(this->random)));
  const auto cells = this->flash.content();
  std::uint32_t last = static_cast<std::uint32_t>(cells.size()) - 1;
  while (cells[last] == 0xFF)
    --last;  // the CRC of the newest record, or of the first in a sector of one record
  this->flash.rot(last, 0x10);
  EXPECT_EQ(load(this->flash).set, first);
  ASSERT_TRUE(commit(this->flash, third));
  EXPECT_EQ(load(this->flash).set, third);
  this->flash.rot(last, 0x10);
  EXPECT_EQ(load(this->flash).set, third) << "a record that comes back to life is not the newest";
}

TYPED_TEST(FaultyStoreOn, AllDamagedFlashGivesDefaultsAndTakesTheNextCommit) {
  for (std::uint32_t at = 0; at < this->flash.content().size(); ++at)
    this->flash.rot(at, static_cast<std::uint8_t>(1 + this->random() % 255));
  const Load damaged = load(this->flash);
  EXPECT_EQ(damaged.status, LoadStatus::no_record);
  EXPECT_EQ(damaged.set, ParameterSet::defaults());
  EXPECT_GE(damaged.skipped, TypeParam::kSectors);
  const ParameterSet set = random_valid_set(this->random);
  ASSERT_TRUE(commit(this->flash, set));
  EXPECT_EQ(load(this->flash).set, set);
}

/// Commits `commits` sets; what was promised last is what each start finds. Returns how many were refused.
template <class Flash>
int refusals(Flash& flash, std::mt19937& random, int commits, const ParameterSet& held) {
  ParameterSet latest = held;
  int refused = 0;
  for (int i = 0; i < commits; ++i) {
    const ParameterSet set = random_valid_set(random);
    Store<Flash> store(flash);
    const auto result = store.commit(set);
    if (result) latest = set;
    if (!result) ++refused;
    EXPECT_TRUE(result || result.error() == CommitError::flash_failed);
    const Load loaded = load(flash);
    EXPECT_EQ(loaded.set, latest) << "commit " << i;
    if (loaded.set != latest) break;
  }
  return refused;
}

TYPED_TEST(FaultyStoreOn, SectorThatFailsIsPassedOverWithoutLosingTheSet) {
  const std::vector<std::vector<FlashWork>> ways{
      {FlashWork::erase}, {FlashWork::program}, {FlashWork::erase, FlashWork::program}};
  for (const auto& way : ways) {
    for (std::uint32_t sector = 0; sector < TypeParam::kSectors; ++sector) {
      TypeParam part;
      ParameterSet held;
      for (int i = 0; i < 40; ++i) ASSERT_TRUE(commit(part, held = random_valid_set(this->random)));
      for (const FlashWork kind : way) part.fail(sector, kind);
      const int refused = refusals(part, this->random, 200, held);
      EXPECT_TRUE(refused == 0 || TypeParam::kSectors == 2) << "two good sectors are left";
    }
  }
}

TYPED_TEST(FaultyStoreOn, AStuckBitInEverySectorCostsTheRoomUnderItAndNoSet) {
  for (const bool level : {false, true}) {
    TypeParam part;
    ParameterSet held = random_valid_set(this->random);
    ASSERT_TRUE(commit(part, held));
    // Behind where the first record of a sector can end, so that each sector still takes one.
    for (std::uint32_t sector = 0; sector < TypeParam::kSectors; ++sector)
      part.stick(sector * TypeParam::kSectorBytes + TypeParam::kSectorBytes * 3 / 4, 0x10, level);
    EXPECT_EQ(refusals(part, this->random, 200, held), 0) << "stuck at " << level;
  }
}

TYPED_TEST(FaultyStoreOn, CellsThatStickOneAfterTheOtherLoseNoSet) {
  constexpr std::uint32_t kSeed = 5;
  std::mt19937 chance(kSeed);
  TypeParam part;
  ParameterSet held = random_valid_set(chance);
  ASSERT_TRUE(commit(part, held));
  int refused = 0;
  for (int cells = 0; cells < 60; ++cells) {
    // A cell under the set in force would be rot: that is for the tests above.
    Record record;
    const auto newest = RecordLog<TypeParam>(part).newest(record);
    std::uint32_t at = newest.at;
    while (at - newest.at < record.size()) at = static_cast<std::uint32_t>(chance() % TypeParam::kBytes);
    part.stick(at, static_cast<std::uint8_t>(1U << chance() % 8), chance() % 2 == 0);
    refused += refusals(part, chance, 10, held);
    held = load(part).set;
  }
  std::printf("seed %u: 60 stuck cells, 600 commits, %d refused, 0 lost sets\n", kSeed, refused);
}

TYPED_TEST(FaultyStoreOn, FlashThatTakesNothingMoreKeepsWhatItHas) {
  ParameterSet held;
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(commit(this->flash, held = random_valid_set(this->random)));
  for (std::uint32_t sector = 0; sector < TypeParam::kSectors; ++sector) {
    this->flash.fail(sector, FlashWork::program);
    this->flash.fail(sector, FlashWork::erase);
  }
  EXPECT_EQ(refusals(this->flash, this->random, 20, held), 20);
}

}  // namespace
}  // namespace astro
