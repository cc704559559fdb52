#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "common/base/crc32.hpp"
#include "tests/common/params/store_on.hpp"

namespace astro {
namespace {

using support::load;
using support::random_valid_set;

template <class Flash>
void must_commit(Flash& flash, const ParameterSet& set) {
  ASSERT_TRUE(support::commit(flash, set));
}

template <class Flash>
using StoreOn = support::StoreOn<Flash>;
TYPED_TEST_SUITE(StoreOn, support::Geometries);

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
    must_commit(this->flash, set);
    const Load loaded = load(this->flash);
    ASSERT_EQ(loaded.status, LoadStatus::loaded);
    ASSERT_EQ(loaded.set, set) << "commit " << i;
    ASSERT_EQ(loaded.sequence, i);
    ASSERT_EQ(loaded.skipped, 0U);
  }
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
    must_commit(this->flash, set);
    const Load loaded = load(this->flash);
    ASSERT_EQ(loaded.sequence, 0xFFFFFFF0U + i);
    ASSERT_EQ(loaded.set, set);
  }
}

/// The record that these bytes become with their length and CRC.
Record closed(std::vector<std::uint8_t> bytes) {
  const std::size_t payload = bytes.size() - Record::kHeaderBytes;
  bytes[6] = static_cast<std::uint8_t>(payload);
  bytes[7] = static_cast<std::uint8_t>(payload >> 8);
  const std::uint32_t crc = crc32(bytes);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(crc >> shift));
  Record record;
  std::ranges::copy(bytes, record.room(bytes.size()).begin());
  return record;
}

/// `record` with one more row, as newer firmware writes it.
Record with_row(const Record& record, std::uint16_t id, const std::vector<std::uint8_t>& value) {
  const auto old = record.bytes(record.size() - Record::kCrcBytes);
  std::vector<std::uint8_t> bytes(old.begin(), old.end());
  bytes.insert(bytes.end(), {static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8),
                             static_cast<std::uint8_t>(value.size())});
  bytes.insert(bytes.end(), value.begin(), value.end());
  return closed(bytes);
}

TYPED_TEST(StoreOn, RowsOfNewerFirmwareOutliveManyCommits) {
  Record record;
  ASSERT_TRUE(record.rewrite(ParameterSet(), 5));
  const std::vector<std::uint8_t> value{0xDE, 0xAD, 0xBE, 0xEF, 0x42};
  const Record newer = with_row(record, 5000, value);
  ASSERT_TRUE(newer.intact());
  plant(this->flash, newer);
  for (int i = 0; i < 50; ++i) must_commit(this->flash, random_valid_set(this->random));
  Record found;
  RecordLog<TypeParam>(this->flash).newest(found);
  const auto bytes = found.bytes(found.size());
  const std::vector<std::uint8_t> row{0x88, 0x13, 5, 0xDE, 0xAD, 0xBE, 0xEF, 0x42};
  EXPECT_NE(std::search(bytes.begin(), bytes.end(), row.begin(), row.end()), bytes.end());
}

/// `record` without its row number `row`, as firmware wrote it that did not have it yet.
Record without_row(const Record& record, std::size_t row) {
  const auto old = record.bytes(record.size() - Record::kCrcBytes);
  std::vector<std::uint8_t> bytes(old.begin(), old.end());
  std::size_t at = Record::kHeaderBytes;
  for (; row > 0; --row) at += 3U + bytes[at + 2];
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  bytes.erase(begin, begin + 3 + bytes[at + 2]);
  return closed(bytes);
}

TYPED_TEST(StoreOn, EveryRowThatOlderFirmwareDidNotHaveTakesItsDefault) {
  for (std::size_t row = 0; row < kParamCount; ++row) {
    const ParamRow& missing = kParamTable[row];
    SCOPED_TRACE(std::string(missing.name));
    Record record;
    const ParameterSet set = random_valid_set(this->random);
    ASSERT_TRUE(record.rewrite(set, 5));
    plant(this->flash, without_row(record, row));
    Record found;
    RecordLog<TypeParam>(this->flash).newest(found);
    ParameterSet expected = set;
    if (missing.kind == ParamKind::text) {
      expected.set_text(missing.id, ParameterSet().text(missing.id));
    } else {
      expected.set(missing.id, ParameterSet().get(missing.id));
    }
    ASSERT_EQ(found.set(), expected);
    const Load loaded = load(this->flash);  // which judges the mixture as a whole
    EXPECT_EQ(loaded.status, validate(expected) ? LoadStatus::loaded : LoadStatus::refused);
  }
}

TYPED_TEST(StoreOn, RollingBackToOldFirmwareAndForwardAgainKeepsWhatTheNewOneSet) {
  Record record;
  ASSERT_TRUE(record.rewrite(random_valid_set(this->random), 5));
  const std::vector<std::uint8_t> value{1, 2, 3, 4};
  plant(this->flash, with_row(record, 900, value));  // new firmware
  const ParameterSet set = random_valid_set(this->random);
  must_commit(this->flash, set);  // old firmware, which does not know row 900
  EXPECT_EQ(load(this->flash).set, set);
  Record found;
  RecordLog<TypeParam>(this->flash).newest(found);
  const std::vector<std::uint8_t> row{0x84, 0x03, 4, 1, 2, 3, 4};
  const auto bytes = found.bytes(found.size());
  EXPECT_NE(std::search(bytes.begin(), bytes.end(), row.begin(), row.end()), bytes.end());
}

TYPED_TEST(StoreOn, FactoryDefaultsAreASetLikeAnyOther) {
  must_commit(this->flash, random_valid_set(this->random));
  must_commit(this->flash, ParameterSet::defaults());
  const Load loaded = load(this->flash);
  EXPECT_EQ(loaded.status, LoadStatus::loaded);
  EXPECT_EQ(loaded.set, ParameterSet::defaults());
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
  must_commit(this->flash, ParameterSet());
  const auto steps = this->flash.bytes_worked();
  ParameterSet bad;
  bad.set(Param::motor_polarity_left, 0);
  Store<TypeParam> store(this->flash);
  const auto result = store.commit(bad);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error(), CommitError::refused);
  EXPECT_EQ(this->flash.bytes_worked(), steps);
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
  const auto steps = this->flash.bytes_worked();
  const auto result = store.commit(random_valid_set(this->random));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error(), CommitError::no_room);
  EXPECT_EQ(this->flash.bytes_worked(), steps) << "the flash was touched";
  EXPECT_EQ(load(this->flash).status, LoadStatus::loaded);
}

}  // namespace
}  // namespace astro
