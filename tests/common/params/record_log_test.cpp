#include "common/params/record_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "common/base/crc32.hpp"
#include "hal/sim/flash.hpp"

// Where a log of records looks for them, at the ends of sectors and of the part.
namespace astro {
namespace {

/// Counts reads that leave the part.
struct StrictFlash : sim::SimulatedFlash<3, 1024, 4> {
  void read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept {
    if (offset > kBytes || into.size() > kBytes - offset) ++outside;
    SimulatedFlash::read(offset, into);
  }
  int outside = 0;
};
using Log = RecordLog<StrictFlash>;

constexpr std::uint32_t kUnitBytes = Log::kUnit, kLogSectorBytes = Log::kSectorBytes;

void put_le(std::vector<std::uint8_t>& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

std::vector<std::uint8_t> header(std::uint32_t payload_bytes, std::uint32_t sequence) {
  std::vector<std::uint8_t> bytes{'A', 'S', 'T', 'P', 1, 0};
  put_le(bytes, payload_bytes, 2);
  put_le(bytes, sequence, 4);
  return bytes;
}

/// An intact record of `units` units, whose one row no firmware knows.
std::vector<std::uint8_t> whole_record(std::uint32_t units, std::uint32_t sequence) {
  const std::uint32_t payload = units * kUnitBytes - 16;
  std::vector<std::uint8_t> bytes = header(payload, sequence);
  put_le(bytes, 0x7001, 2);
  bytes.push_back(static_cast<std::uint8_t>(payload - 3));
  bytes.resize(12 + payload, 0x55);
  put_le(bytes, crc32(bytes), 4);
  return bytes;
}

Log::Newest found_in(StrictFlash& flash) {
  Record record;
  return Log(flash).newest(record);
}

TEST(RecordLog, ARottenLengthInTheLastUnitIsNotFollowedOutOfThePart) {
  for (std::uint32_t sector = 0; sector < Log::kSectors; ++sector) {
    StrictFlash flash;
    flash.put_back(0, whole_record(4, 7));
    flash.put_back((sector + 1) * kLogSectorBytes - kUnitBytes, header(500, 8));
    const Log::Newest newest = found_in(flash);
    EXPECT_TRUE(newest.found);
    EXPECT_EQ(newest.sequence, 7U);
    EXPECT_EQ(newest.skipped, 1U);
    EXPECT_TRUE(newest.outrun()) << "the damaged one says it is newer";
    EXPECT_EQ(flash.outside, 0) << "sector " << sector;
  }
}

TEST(RecordLog, ADamagedRecordIsReportedAsNewerWhateverItsSequenceNumber) {
  for (const std::uint32_t sequence : {0U, 1U, 0x7FFF'FFFFU, 0x8000'0000U, 0xFFFF'FFFFU}) {
    StrictFlash flash;
    flash.put_back(0, whole_record(4, sequence - 1));
    flash.put_back(kLogSectorBytes, header(500, sequence));
    EXPECT_TRUE(found_in(flash).outrun()) << sequence;
  }
}

TEST(RecordLog, ARecordMayFillItsSectorToTheLastByte) {
  for (std::uint32_t sector = 0; sector < Log::kSectors; ++sector) {
    StrictFlash flash;
    const auto record = whole_record(4, 7);
    const auto at = static_cast<std::uint32_t>((sector + 1) * kLogSectorBytes - record.size());
    flash.put_back(at, record);
    const Log::Newest newest = found_in(flash);
    EXPECT_TRUE(newest.found);
    EXPECT_EQ(newest.at, at);
    EXPECT_EQ(newest.sector(), sector);
    EXPECT_EQ(newest.skipped, 0U);
    EXPECT_EQ(flash.outside, 0);
  }
}

TEST(RecordLog, ARecordThatReachesIntoTheNextSectorIsNone) {
  // Half of it would go with the next erase.
  for (std::uint32_t sector = 0; sector + 1 < Log::kSectors; ++sector) {
    StrictFlash flash;
    const auto record = whole_record(4, 7);
    flash.put_back(static_cast<std::uint32_t>((sector + 1) * kLogSectorBytes - record.size() + kUnitBytes),
                   record);
    EXPECT_FALSE(found_in(flash).found) << sector;
  }
}

TEST(RecordLog, IsAppendedToBehindEverythingThatIsNotBlank) {
  StrictFlash flash;
  flash.rot(5 * kUnitBytes + 3, 0x01);  // one bit in the sixth unit
  Record record;
  ASSERT_TRUE(record.rewrite(ParameterSet{}, 1));
  ASSERT_TRUE(Log(flash).append(0, record));
  const Log::Newest newest = found_in(flash);
  EXPECT_EQ(newest.at, 6 * kUnitBytes);
  EXPECT_EQ(newest.skipped, 1U);
}

TEST(RecordLog, IsAppendedToAtTheStartOfABlankSectorAndNotBeforeIt) {
  for (std::uint32_t sector = 0; sector < Log::kSectors; ++sector) {
    StrictFlash flash;
    Record record;
    ASSERT_TRUE(record.rewrite(ParameterSet{}, 1));
    ASSERT_TRUE(Log(flash).append(sector, record));
    EXPECT_EQ(found_in(flash).at, sector * kLogSectorBytes);
    EXPECT_EQ(flash.outside, 0);
  }
}

// Against the obvious way: all records in a list. Sequence numbers start shortly before they wrap.
TEST(RecordLog, FindsTheNewestAndTheNewestOutsideItsSectorWhereverTheyLie) {
  struct Placed {
    std::uint32_t at, age;
    std::uint32_t sector() const { return at / kLogSectorBytes; }
  };
  std::mt19937 random(20'261'122);
  for (int round = 0; round < 500; ++round) {
    StrictFlash flash;
    std::vector<Placed> placed;
    std::vector<std::uint32_t> ages(12);
    std::iota(ages.begin(), ages.end(), 0U);
    std::ranges::shuffle(ages, random);
    for (std::uint32_t sector = 0; sector < Log::kSectors; ++sector)
      for (std::uint32_t i = 0, records = static_cast<std::uint32_t>(random() % 5); i < records; ++i) {
        placed.push_back({sector * kLogSectorBytes + i * 4 * kUnitBytes, ages.back()});
        ages.pop_back();
        flash.put_back(placed.back().at, whole_record(4, UINT32_MAX - 5 + placed.back().age));
      }
    const Log::Newest newest = found_in(flash);
    ASSERT_EQ(newest.found, !placed.empty());
    if (placed.empty()) continue;
    const Placed& youngest = *std::ranges::max_element(placed, {}, &Placed::age);
    EXPECT_EQ(newest.at, youngest.at);
    EXPECT_EQ(newest.sequence, UINT32_MAX - 5 + youngest.age);
    EXPECT_FALSE(newest.outrun());
    std::erase_if(placed, [sector = youngest.sector()](const Placed& one) { return one.sector() == sector; });
    ASSERT_EQ(newest.found_outside, !placed.empty()) << round;
    if (placed.empty()) continue;
    EXPECT_EQ(newest.outside, UINT32_MAX - 5 + std::ranges::max_element(placed, {}, &Placed::age)->age)
        << round;
  }
}

}  // namespace
}  // namespace astro
