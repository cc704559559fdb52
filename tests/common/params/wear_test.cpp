#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/common/params/store_on.hpp"

/// How often sectors are erased, on the parameters' sectors of the reference robot.
namespace astro {
namespace {

using ParameterSectors = sim::SimulatedFlash<4, 4096, 8>;
constexpr int kCommits = ASTRO_WEAR_COMMITS;

/// Erases per sector, (most - least) / mean, after kCommits; sector `unused`, if any, does not count.
double spread(ParameterSectors& flash, std::uint32_t unused = ParameterSectors::kSectors) {
  Store<ParameterSectors> store(flash);
  ParameterSet set;
  for (int i = 0; i < kCommits; ++i) {
    set.set(Param::kp, i);
    EXPECT_TRUE(store.commit(set)) << i;
  }
  EXPECT_EQ(store.load().set, set);
  std::uint32_t least = ~0U, most = 0, sum = 0, count = 0;
  std::printf("%d commits, erases per sector:", kCommits);
  for (std::uint32_t sector = 0; sector < flash.kSectors; ++sector) {
    const std::uint32_t erases = flash.erases(sector);
    std::printf(" %u%s", erases, sector == unused ? " (failing)" : "");
    if (sector == unused) continue;
    least = std::min(least, erases);
    most = std::max(most, erases);
    sum += erases;
    ++count;
  }
  const double spread = static_cast<double>(most - least) * count / sum;
  std::printf("; spread %.3f %%\n", spread * 100);
  return spread;
}

TEST(Wear, IsTheSameOnAllSectors) {
  ParameterSectors flash;
  EXPECT_LE(spread(flash), 0.10);
}

TEST(Wear, IsTheSameOnTheSectorsThatAreLeftWhenOneFails) {
  ParameterSectors flash;
  flash.fail(2, sim::FlashWork::program);
  EXPECT_LE(spread(flash, 2), 0.10);
  EXPECT_LE(flash.erases(2), flash.erases(1) + 1)
      << "and the failing one is not tried more often than they are";
}

TEST(Wear, OfOneCommitIsOneRecordAndSeldomAnErase) {
  ParameterSectors flash;
  Record record;
  ASSERT_TRUE(record.rewrite(ParameterSet(), 0));
  constexpr std::uint32_t kUnit = RecordLog<ParameterSectors>::kUnit;
  const auto padded = (static_cast<std::uint32_t>(record.size()) + kUnit - 1) / kUnit * kUnit;
  const std::uint32_t per_sector = flash.kSectorBytes / padded;
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(support::commit(flash, ParameterSet()));
  std::uint32_t erases = 0;
  for (std::uint32_t sector = 0; sector < flash.kSectors; ++sector) erases += flash.erases(sector);
  EXPECT_EQ(erases, (1000 + per_sector - 1) / per_sector);
  std::printf(
      "a record of %zu bytes, %u to a sector: 100,000 erases of each sector are %.1f million commits\n",
      record.size(), per_sector, 0.1 * flash.kSectors * per_sector);
}

}  // namespace
}  // namespace astro
