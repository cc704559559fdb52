#include "common/params/store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "common/base/crc32.hpp"
#include "tests/common/params/random_set.hpp"
#include "tests/support/nor_flash.hpp"

namespace astro {
namespace {

using support::random_valid_set;

template <class Flash>
Load load(Flash& flash) {  // as after a reboot: nothing but the flash is left
  Store<Flash> store(flash);
  return store.load();
}

template <class Flash>
void commit(Flash& flash, const ParameterSet& set) {
  Store<Flash> store(flash);
  ASSERT_TRUE(store.commit(set));
}

/// The same claims on the geometries of a small NOR chip, of a processor's page-programmed flash and of
/// byte-wise EEPROM emulation.
template <class Flash>
class StoreOn : public ::testing::Test {
 protected:
  Flash flash{1};
  std::mt19937 random{7};

  void TearDown() override { EXPECT_EQ(flash.misuses(), 0); }
};
using Geometries = ::testing::Types<support::NorFlash<2, 4096, 4>, support::NorFlash<4, 4096, 256>,
                                    support::NorFlash<3, 1024, 1>>;
TYPED_TEST_SUITE(StoreOn, Geometries);

TYPED_TEST(StoreOn, FreshFlashGivesFactoryDefaults) {
  const Load fresh = load(this->flash);
  EXPECT_EQ(fresh.status, LoadStatus::no_record);
  EXPECT_EQ(fresh.set, ParameterSet::defaults());
  EXPECT_EQ(fresh.skipped, 0U);
  EXPECT_EQ(fresh.refused, Param::none);
}

TYPED_TEST(StoreOn, ThousandCommitsEachSurviveAReboot) {
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const ParameterSet set = random_valid_set(this->random);
    commit(this->flash, set);
    const Load loaded = load(this->flash);
    ASSERT_EQ(loaded.status, LoadStatus::loaded);
    ASSERT_EQ(loaded.set, set) << "commit " << i;
    ASSERT_EQ(loaded.sequence, i);
    ASSERT_EQ(loaded.skipped, 0U);
  }
}

TYPED_TEST(StoreOn, WearIsSpreadEvenlyOverTheSectors) {
  for (int i = 0; i < 1000; ++i) commit(this->flash, random_valid_set(this->random));
  std::vector<std::uint32_t> erases;
  for (std::uint32_t sector = 0; sector < TypeParam::kSectors; ++sector) {
    erases.push_back(this->flash.erases(sector));
  }
  const auto [least, most] = std::ranges::minmax(erases);
  EXPECT_GE(least, 1U);
  EXPECT_LE(most - least, 1U);
}

TYPED_TEST(StoreOn, SectorIsFilledBeforeTheNextOneIsErased) {
  Record record;
  ASSERT_TRUE(record.rewrite(ParameterSet(), 0));
  constexpr std::uint32_t kUnit = RecordLog<TypeParam>::kUnit;
  const auto padded = (static_cast<std::uint32_t>(record.size()) + kUnit - 1) / kUnit * kUnit;
  const std::uint32_t per_sector = TypeParam::kSectorBytes / padded;
  for (std::uint32_t i = 0; i < 1000; ++i) commit(this->flash, random_valid_set(this->random));
  std::uint32_t erases = 0;
  for (std::uint32_t sector = 0; sector < TypeParam::kSectors; ++sector) erases += this->flash.erases(sector);
  EXPECT_EQ(erases, (1000 + per_sector - 1) / per_sector);
}

TYPED_TEST(StoreOn, BitRotInTheNewestRecordFallsBackToTheOneBefore) {
  const ParameterSet older = random_valid_set(this->random);
  const ParameterSet newer = random_valid_set(this->random);
  commit(this->flash, older);
  const std::vector<std::uint8_t> before(this->flash.cells().begin(), this->flash.cells().end());
  commit(this->flash, newer);
  for (std::uint32_t at = 0; at < before.size(); ++at) {
    if (this->flash.cells()[at] == before[at]) continue;  // not a byte of the newest record
    const auto mask = static_cast<std::uint8_t>(1U << (at % 8));
    this->flash.flip_bits(at, mask);
    const Load loaded = load(this->flash);
    ASSERT_EQ(loaded.status, LoadStatus::loaded);
    ASSERT_EQ(loaded.set, older) << "rot at " << at;
    ASSERT_EQ(loaded.skipped, 1U) << "rot at " << at;
    this->flash.flip_bits(at, mask);
  }
  EXPECT_EQ(load(this->flash).set, newer);
}

TYPED_TEST(StoreOn, CommitAfterBitRotWinsOverTheRottenRecord) {
  const ParameterSet first = random_valid_set(this->random), third = random_valid_set(this->random);
  commit(this->flash, first);
  commit(this->flash, random_valid_set(this->random));
  const auto cells = this->flash.cells();
  std::uint32_t last = static_cast<std::uint32_t>(cells.size()) - 1;
  while (cells[last] == 0xFF)
    --last;  // the CRC of the newest record, or of the first in a sector of one record
  this->flash.flip_bits(last, 0x10);
  EXPECT_EQ(load(this->flash).set, first);
  commit(this->flash, third);
  EXPECT_EQ(load(this->flash).set, third);
}

TYPED_TEST(StoreOn, AllDamagedFlashGivesDefaultsAndTakesTheNextCommit) {
  for (std::uint32_t at = 0; at < this->flash.cells().size(); ++at) {
    this->flash.flip_bits(at, static_cast<std::uint8_t>(1 + this->random() % 255));
  }
  const Load damaged = load(this->flash);
  EXPECT_EQ(damaged.status, LoadStatus::no_record);
  EXPECT_EQ(damaged.set, ParameterSet::defaults());
  EXPECT_GE(damaged.skipped, TypeParam::kSectors);
  const ParameterSet set = random_valid_set(this->random);
  commit(this->flash, set);
  EXPECT_EQ(load(this->flash).set, set);
}

/// Puts a record into the flash as another firmware would have.
template <class Flash>
void plant(Flash& flash, const Record& record) {
  std::vector<std::uint8_t> bytes(Flash::kSectorBytes, 0xFF);
  std::ranges::copy(record.bytes(record.size()), bytes.begin());
  ASSERT_TRUE(flash.erase(0));
  ASSERT_TRUE(flash.program(0, bytes));
}

TYPED_TEST(StoreOn, NewestStaysNewestWhileTheSequenceWraps) {
  Record record;
  ASSERT_TRUE(record.rewrite(ParameterSet(), 0xFFFFFFF0U));
  plant(this->flash, record);
  for (std::uint32_t i = 1; i <= 100; ++i) {
    const ParameterSet set = random_valid_set(this->random);
    commit(this->flash, set);
    const Load loaded = load(this->flash);
    ASSERT_EQ(loaded.sequence, 0xFFFFFFF0U + i);
    ASSERT_EQ(loaded.set, set);
  }
}

/// `record` with one more row, as newer firmware writes it.
Record with_row(const Record& record, std::uint16_t id, const std::vector<std::uint8_t>& value) {
  const auto old = record.bytes(record.size() - Record::kCrcBytes);
  std::vector<std::uint8_t> bytes(old.begin(), old.end());
  bytes.insert(bytes.end(), {static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8),
                             static_cast<std::uint8_t>(value.size())});
  bytes.insert(bytes.end(), value.begin(), value.end());
  const std::size_t payload = bytes.size() - Record::kHeaderBytes;
  bytes[6] = static_cast<std::uint8_t>(payload);
  bytes[7] = static_cast<std::uint8_t>(payload >> 8);
  const std::uint32_t crc = crc32(bytes);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(crc >> shift));
  Record longer;
  std::ranges::copy(bytes, longer.room(bytes.size()).begin());
  return longer;
}

TYPED_TEST(StoreOn, RowsOfNewerFirmwareOutliveManyCommits) {
  Record record;
  ASSERT_TRUE(record.rewrite(ParameterSet(), 5));
  const std::vector<std::uint8_t> value{0xDE, 0xAD, 0xBE, 0xEF, 0x42};
  const Record newer = with_row(record, 5000, value);
  ASSERT_TRUE(newer.intact());
  plant(this->flash, newer);
  for (int i = 0; i < 50; ++i) commit(this->flash, random_valid_set(this->random));
  Record found;
  RecordLog<TypeParam>(this->flash).newest(found);
  const auto bytes = found.bytes(found.size());
  const std::vector<std::uint8_t> row{0x88, 0x13, 5, 0xDE, 0xAD, 0xBE, 0xEF, 0x42};
  EXPECT_FALSE(std::ranges::search(bytes, row).empty());
}

TYPED_TEST(StoreOn, SetThatThisFirmwareRefusesGivesDefaultsAndNamesTheRow) {
  ParameterSet bad;
  bad.set(Param::ki, -1);
  Record record;
  ASSERT_TRUE(record.rewrite(bad, 5));
  plant(this->flash, record);
  const Load loaded = load(this->flash);
  EXPECT_EQ(loaded.status, LoadStatus::refused);
  EXPECT_EQ(loaded.refused, Param::ki);
  EXPECT_EQ(loaded.set, ParameterSet::defaults());
}

TYPED_TEST(StoreOn, RefusesToCommitAnInvalidSetAndLeavesTheFlashAlone) {
  commit(this->flash, ParameterSet());
  const auto steps = this->flash.steps();
  ParameterSet bad;
  bad.set(Param::motor_polarity_left, 0);
  Store<TypeParam> store(this->flash);
  const auto result = store.commit(bad);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error(), CommitError::refused);
  EXPECT_EQ(this->flash.steps(), steps);
}

TYPED_TEST(StoreOn, RefusesToCommitWhenRowsOfNewerFirmwareFillTheRecord) {
  Record record;
  constexpr std::array<std::uint8_t, 16> kNoRows{'A', 'S', 'T', 'P', 1};
  std::ranges::copy(kNoRows, record.room(kNoRows.size()).begin());
  for (const std::uint16_t id : {std::uint16_t{5000}, std::uint16_t{5001}, std::uint16_t{5002}}) {
    record = with_row(record, id, std::vector<std::uint8_t>(255, 1));
  }
  ASSERT_TRUE(record.intact());
  plant(this->flash, record);
  Store<TypeParam> store(this->flash);
  const auto steps = this->flash.steps();
  const auto result = store.commit(random_valid_set(this->random));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error(), CommitError::no_room);
  EXPECT_EQ(this->flash.steps(), steps) << "the flash was touched";
  EXPECT_EQ(load(this->flash).status, LoadStatus::loaded);
}

TYPED_TEST(StoreOn, WornSectorIsPassedOverWithoutLosingTheSet) {
  const ParameterSet old = random_valid_set(this->random);
  commit(this->flash, old);
  this->flash.wear_out(1);
  ParameterSet latest = old;
  int refused = 0;
  for (int i = 0; i < 100; ++i) {
    const ParameterSet set = random_valid_set(this->random);
    Store<TypeParam> store(this->flash);
    const auto result = store.commit(set);
    if (result) latest = set;
    if (!result) {
      EXPECT_EQ(result.error(), CommitError::flash_failed);
      ++refused;
    }
    ASSERT_EQ(load(this->flash).set, latest) << "commit " << i;
  }
  if (TypeParam::kSectors > 2) {
    EXPECT_LT(refused, 100);
  }
}

}  // namespace
}  // namespace astro
