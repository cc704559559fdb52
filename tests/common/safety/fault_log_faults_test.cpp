#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "tests/common/safety/fault_log_on.hpp"
#include "tests/support/base/thorough.hpp"

/// The power fails after every byte, bits rot and stick, sectors fail: logged entries survive, except the one
/// that is being written and those that the ring erases.
namespace astro {
namespace {

using sim::FlashWork;
using sim::Tear;
using support::append;
using support::circumstances;
using support::entries;

template <class Flash>
using FaultyLogOn = support::FaultLogOn<Flash>;
TYPED_TEST_SUITE(FaultyLogOn, support::LogGeometries);

template <class Flash>
struct CutSweep {
  static constexpr std::uint32_t kAll = FaultLog<Flash>::kSlots * Flash::kSectors;
  std::uint64_t cuts = 0, lost = 0;

  /// Cuts the logging of `n` after each byte; the entries before it are in `flash`.
  void run(const Flash& flash, std::uint32_t n, Tear tear) {
    Flash whole = flash;
    const auto old = entries(whole);
    const std::uint64_t before = whole.bytes_worked();
    ASSERT_TRUE(append(whole, n));
    const std::uint64_t work = whole.bytes_worked() - before;
    // Each time at every seventh byte, of each entry from another one on, so that all entries together have all bytes cut.
    const auto step = static_cast<std::uint64_t>(support::how_often(7, 1));
    for (std::uint64_t cut = n % step; cut <= work; cut += step) {
      Flash broken = flash;
      broken.cut_power_after(cut, tear, cut + n);
      const bool done = append(broken, n);
      broken.restore_power();
      auto held = entries(broken);
      ++cuts;
      const bool logged = !held.empty() && held.front().was == circumstances(n);
      ASSERT_TRUE(logged || !done) << "said to be logged, and lost";
      if (logged) held.erase(held.begin());
      // The oldest sector may be gone, or half gone; all that is newer is there.
      const std::size_t kept = std::min<std::size_t>(old.size(), kAll - FaultLog<Flash>::kSlots);
      if (held.size() < kept ||
          !std::equal(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(kept), held.begin()))
        ++lost;
      ASSERT_EQ(lost, 0U) << "entry " << n << " cut after " << cut << " of " << work;
      ASSERT_TRUE(append(broken, n + 1)) << "entry " << n << " cut after " << cut;
      ASSERT_EQ(entries(broken).front().was, circumstances(n + 1));
    }
  }
};

TYPED_TEST(FaultyLogOn, PowerCutAfterAnyByteLosesTheEntryUnderWayAndNoOther) {
  CutSweep<TypeParam> sweep;
  // Round the ring and into its second turn; in the middle of a sector one entry is as good as the next.
  for (std::uint32_t n = 1; n <= 2 * sweep.kAll + 2; ++n) {
    const std::uint32_t slot = (n - 1) % this->kSlots;
    const bool telling = slot < 2 || slot + 1 == this->kSlots;
    for (const Tear tear : {Tear::sharp, Tear::byte, Tear::torn}) {
      if (telling) sweep.run(this->flash, n, tear);
      if (this->HasFatalFailure()) return;
    }
    ASSERT_TRUE(append(this->flash, n));
  }
  std::printf("%llu cuts, %llu entries lost that were not under way\n",
              static_cast<unsigned long long>(sweep.cuts), static_cast<unsigned long long>(sweep.lost));
}

TYPED_TEST(FaultyLogOn, CutAfterCutTheLogGoesOn) {
  constexpr std::uint32_t kSeed = 31;
  std::mt19937 random(kSeed);
  std::uint32_t logged = 0;
  for (std::uint32_t n = 1; n <= 2000; ++n) {
    this->flash.cut_power_after(random() % (TypeParam::kSectorBytes + 200), static_cast<Tear>(random() % 3),
                                random());
    const bool done = append(this->flash, n);
    this->flash.restore_power();
    const auto held = entries(this->flash);
    if (done) logged = n;
    ASSERT_TRUE(logged == 0 || held.front().was.left_umps >= static_cast<std::int32_t>(logged))
        << "seed " << kSeed << ", entry " << n;
    for (std::size_t i = 1; i < held.size(); ++i)
      ASSERT_LT(held[i].was.left_umps, held[i - 1].was.left_umps) << "in order";
  }
}

TYPED_TEST(FaultyLogOn, ARottenEntryIsPassedOver) {
  const std::uint32_t count = this->kSlots + 2;
  for (std::uint32_t n = 1; n <= count; ++n) ASSERT_TRUE(append(this->flash, n));
  this->flash.rot(20, 0x04);  // of the first entry
  EXPECT_EQ(entries(this->flash).size(), count - 1);
  this->flash.rot(TypeParam::kSectorBytes + FaultLog<TypeParam>::kSlotBytes + 30, 0x80);  // of the newest
  ASSERT_EQ(entries(this->flash).size(), count - 2);
  EXPECT_EQ(entries(this->flash).front().was, circumstances(count - 1));
  ASSERT_TRUE(append(this->flash, count + 1));
  EXPECT_EQ(entries(this->flash).front().was, circumstances(count + 1));
  EXPECT_EQ(entries(this->flash).size(), count - 1);
}

TYPED_TEST(FaultyLogOn, ASlotWithAStuckCellIsPassedOver) {
  this->flash.stick(FaultLog<TypeParam>::kSlotBytes + 9, 0x01, true);
  this->flash.stick(2 * FaultLog<TypeParam>::kSlotBytes + 9, 0x01, false);
  for (std::uint32_t n = 1; n <= 3 * this->kSlots * TypeParam::kSectors; ++n) {
    ASSERT_TRUE(append(this->flash, n));
    ASSERT_EQ(entries(this->flash).front().was, circumstances(n));
    ASSERT_GE(entries(this->flash).size(), std::min(n, (TypeParam::kSectors - 1) * this->kSlots - 2));
  }
}

TYPED_TEST(FaultyLogOn, ASectorThatFailsHoldsTheLogUpOnlyWhenItIsTheLast) {
  for (const FlashWork kind : {FlashWork::erase, FlashWork::program}) {
    TypeParam part;
    for (std::uint32_t n = 1; n <= this->kSlots; ++n) ASSERT_TRUE(append(part, n));
    for (std::uint32_t sector = 1; sector < TypeParam::kSectors; ++sector) part.fail(sector, kind);
    for (std::uint32_t n = this->kSlots + 1; n <= 5 * this->kSlots * TypeParam::kSectors; ++n) {
      ASSERT_TRUE(append(part, n));
      ASSERT_EQ(entries(part).front().was, circumstances(n)) << "entry " << n;
    }
    part.fail(0, FlashWork::program);
    part.fail(0, FlashWork::erase);
    bool taken = true;
    for (std::uint32_t n = 0; n <= this->kSlots * TypeParam::kSectors; ++n) taken = append(part, 9000 + n);
    EXPECT_FALSE(taken) << "no sector is left";
  }
}

}  // namespace
}  // namespace astro
