#include "common/params/record.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "common/base/crc32.hpp"

namespace astro {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const Record& record) {
  const auto bytes = record.bytes(record.size());
  return {bytes.begin(), bytes.end()};
}

Record record_of(const Bytes& bytes) {
  Record record;
  std::ranges::copy(bytes, record.room(bytes.size()).begin());
  return record;
}

Record record_of(const ParameterSet& set, std::uint32_t sequence) {
  Record record;
  EXPECT_TRUE(record.rewrite(set, sequence));
  return record;
}

/// Any raw values at all: what is stored need not be valid.
ParameterSet arbitrary_set() {
  ParameterSet set;
  for (const ParamRow& row : kParamTable) {
    if (row.kind == ParamKind::text) {
      set.set_text(row.id, ParamText(*rc::gen::arbitrary<std::string>()));
    } else {
      set.set(row.id, *rc::gen::arbitrary<std::int32_t>());
    }
  }
  return set;
}

/// The record that a firmware would write whose table has exactly these rows.
Bytes foreign_record(const std::vector<std::pair<std::uint16_t, Bytes>>& rows, std::uint8_t version = 1) {
  Bytes payload;
  for (const auto& [id, value] : rows) {
    payload.insert(payload.end(), {static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8),
                                   static_cast<std::uint8_t>(value.size())});
    payload.insert(payload.end(), value.begin(), value.end());
  }
  const auto size = payload.size();
  Bytes record{
      'A', 'S', 'T', 'P', version, 0, static_cast<std::uint8_t>(size), static_cast<std::uint8_t>(size >> 8),
      7,   0,   0,   0};
  record.insert(record.end(), payload.begin(), payload.end());
  const std::uint32_t crc = crc32(record);
  for (int shift = 0; shift < 32; shift += 8) record.push_back(static_cast<std::uint8_t>(crc >> shift));
  return record;
}

RC_GTEST_PROP(Record, GivesBackTheSetAndTheSequenceThatWentIn, ()) {
  const ParameterSet set = arbitrary_set();
  const auto sequence = *rc::gen::arbitrary<std::uint32_t>();
  const Record read = record_of(bytes_of(record_of(set, sequence)));
  RC_ASSERT(read.intact());
  RC_ASSERT(read.sequence() == sequence);
  RC_ASSERT(read.set() == set);
}

TEST(Record, LiesInFlashAsItsHeaderSays) {
  ParameterSet set;
  set.set(Param::c_R, 0x3FEDCBA9);
  const Bytes bytes = bytes_of(record_of(set, 0x01020304));
  const Bytes begin{'A', 'S', 'T', 'P', 1, 0};
  EXPECT_TRUE(std::ranges::equal(begin, std::span(bytes).first(6)));
  EXPECT_EQ(bytes[6] + 256U * bytes[7], bytes.size() - 16);
  const Bytes sequence_and_first_row{4, 3, 2, 1, 1, 0, 4, 0xA9, 0xCB, 0xED, 0x3F};
  EXPECT_TRUE(std::ranges::equal(sequence_and_first_row, std::span(bytes).subspan(8, 11)));
  EXPECT_EQ(Record::announced_bytes(bytes), bytes.size());
}

TEST(Record, IsFollowedByErasedBytes) {
  const Record record = record_of(ParameterSet(), 1);
  const auto padded = record.bytes(Record::kMaxBytes).subspan(record.size());
  EXPECT_TRUE(std::ranges::all_of(padded, [](std::uint8_t byte) { return byte == 0xFF; }));
}

TEST(Record, NoticesEveryFlippedBitAndEveryMissingByte) {
  const Bytes good = bytes_of(record_of(ParameterSet(), 99));
  ASSERT_TRUE(record_of(good).intact());
  for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
    Bytes bad = good;
    bad[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    ASSERT_FALSE(record_of(bad).intact()) << "bit " << bit;
  }
  for (std::size_t size = 0; size < good.size(); ++size) {
    ASSERT_FALSE(record_of(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))).intact());
  }
}

TEST(Record, BlankOrForeignBytesAnnounceNoRecord) {
  EXPECT_EQ(Record::announced_bytes(Bytes(16, 0xFF)), 0U);
  EXPECT_EQ(Record::announced_bytes(Bytes(16, 0x00)), 0U);
  EXPECT_EQ(Record::announced_bytes(foreign_record({}, 2)), 0U) << "a format of the future";
  Bytes too_long = foreign_record({});
  too_long[7] = 4;  // 1024 bytes of payload
  EXPECT_EQ(Record::announced_bytes(too_long), 0U);
}

TEST(Record, OfOlderFirmwareLeavesNewRowsAtTheirDefaults) {
  const Record record = record_of(foreign_record({{static_cast<std::uint16_t>(Param::ki), {0, 0, 5, 0}},
                                                  {static_cast<std::uint16_t>(Param::b), {0, 0, 0, 0x10}}}));
  ASSERT_TRUE(record.intact());
  ParameterSet expected;
  expected.set(Param::ki, 5 << 16);
  expected.set(Param::b, 1 << 28);
  EXPECT_EQ(record.set(), expected);
}

TEST(Record, OfNewerFirmwareKeepsItsRowsWhenTheSetIsRewritten) {
  const std::pair<std::uint16_t, Bytes> number{900, {1, 2, 3, 4}}, long_text{901, Bytes(200, 'x')},
      empty{65535, {}};
  const std::pair<std::uint16_t, Bytes> known{static_cast<std::uint16_t>(Param::kp), {0, 0, 9, 0}};
  Record record = record_of(foreign_record({number, known, long_text, known, empty}));
  ASSERT_TRUE(record.intact());
  EXPECT_EQ(record.set().get(Param::kp), 9 << 16);

  ParameterSet changed;
  changed.set(Param::kp, 3 << 16);
  for (std::uint32_t sequence = 8; sequence < 12; ++sequence) {
    ASSERT_TRUE(record.rewrite(changed, sequence));
    ASSERT_TRUE(record.intact());
    EXPECT_EQ(record.set(), changed);
    EXPECT_EQ(record.sequence(), sequence);
    const Bytes bytes = bytes_of(record);
    const Bytes kept = foreign_record({number, long_text, empty});
    EXPECT_TRUE(std::equal(kept.begin() + 12, kept.end() - 4, bytes.begin() + 12)) << "after " << sequence;
  }
}

TEST(Record, RefusesToBeRewrittenWhenRowsOfNewerFirmwareFillIt) {
  Record record =
      record_of(foreign_record({{900, Bytes(255, 1)}, {901, Bytes(255, 2)}, {902, Bytes(255, 3)}}));
  ASSERT_TRUE(record.intact());
  EXPECT_FALSE(record.rewrite(ParameterSet(), 8));
  EXPECT_FALSE(record.intact());
}

TEST(Record, WithRowsThatCannotBeReadIsNotIntactThoughItsCrcIsGood) {
  EXPECT_FALSE(record_of(foreign_record({{static_cast<std::uint16_t>(Param::kp), {1, 2}}})).intact());
  Bytes cut_row = foreign_record({{900, {1, 2, 3}}});
  cut_row[14] = 4;  // says one byte more than there is
  const std::uint32_t crc = crc32(std::span(cut_row).first(cut_row.size() - 4));
  for (std::size_t i = 0; i < 4; ++i)
    cut_row[cut_row.size() - 4 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
  EXPECT_FALSE(record_of(cut_row).intact());
}

RC_GTEST_PROP(Record, TakesAnyBytesWithoutHarm, (std::vector<std::uint8_t> payload)) {
  payload.resize(std::min<std::size_t>(payload.size(), 1000));
  const auto size = payload.size();
  Bytes bytes{'A', 'S', 'T', 'P', 1, 0, static_cast<std::uint8_t>(size), static_cast<std::uint8_t>(size >> 8),
              1,   0,   0,   0};
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  const std::uint32_t crc = crc32(bytes);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(crc >> shift));
  Record record = record_of(bytes);
  if (record.intact()) static_cast<void>(record.set());
  ParameterSet set;
  set.set(Param::kp, 77);
  if (record.rewrite(set, 2)) RC_ASSERT(record.intact() && record.set() == set);
}

}  // namespace
}  // namespace astro
