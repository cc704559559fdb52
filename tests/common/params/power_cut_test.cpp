#include <gtest/gtest.h>

#include <cstdio>

#include "tests/common/params/store_on.hpp"

/// The power goes after every single byte of a commit: the next start finds the old set or the new one and
/// the next commit works.
namespace astro {
namespace {

using sim::Tear;
using support::commit;
using support::load;
using support::random_valid_set;

struct Tally {
  std::uint64_t cuts = 0, kept_old = 0, had_new = 0;
};

/// Cuts the commit of `fresh` over `old` (which `flash` holds) after every byte.
template <class Flash>
void cut_everywhere(const Flash& flash, const ParameterSet& old, std::mt19937& random, Tear tear,
                    Tally& tally) {
  const ParameterSet fresh = random_valid_set(random), after = random_valid_set(random);
  Flash whole = flash;
  const auto before = whole.bytes_worked();
  ASSERT_TRUE(commit(whole, fresh));
  const std::uint64_t work = whole.bytes_worked() - before;
  for (std::uint64_t cut = 0; cut <= work; ++cut) {
    Flash broken = flash;
    broken.cut_power_after(cut, tear, random());
    static_cast<void>(commit(broken, fresh));
    ASSERT_FALSE(broken.powered());
    broken.restore_power();
    const Load loaded = load(broken);
    ASSERT_TRUE(loaded.set == old || loaded.set == fresh) << "cut after " << cut << " of " << work;
    ++tally.cuts;
    ++(loaded.set == old ? tally.kept_old : tally.had_new);
    ASSERT_TRUE(commit(broken, after)) << "cut after " << cut << " of " << work;
    ASSERT_EQ(load(broken).set, after) << "cut after " << cut << " of " << work;
    ASSERT_EQ(broken.misuses(), 0);
  }
}

template <class Flash>
class PowerCutOn : public ::testing::Test {};
using Geometries = ::testing::Types<sim::SimulatedFlash<2, 2048, 4>, sim::SimulatedFlash<3, 1024, 256>,
                                    sim::SimulatedFlash<2, 1024, 1>>;
TYPED_TEST_SUITE(PowerCutOn, Geometries);

TYPED_TEST(PowerCutOn, EveryByteOfACommitLeavesTheOldOrTheNewSet) {
  constexpr std::uint32_t kSeed = 11;
  std::mt19937 random(kSeed);
  Tally tally;
  for (const Tear tear : {Tear::byte, Tear::torn}) {
    // From fresh flash on, long enough to pass through appends and through erases of every sector.
    TypeParam flash;
    ParameterSet old;
    for (int i = 0; i < 12; ++i) {
      cut_everywhere(flash, old, random, tear, tally);
      if (this->HasFatalFailure()) return;
      old = random_valid_set(random);
      ASSERT_TRUE(commit(flash, old));
    }
  }
  std::printf("seed %u, %llu cuts: %llu times the old set, %llu times the new one\n", kSeed,
              static_cast<unsigned long long>(tally.cuts), static_cast<unsigned long long>(tally.kept_old),
              static_cast<unsigned long long>(tally.had_new));
  EXPECT_GT(tally.kept_old, 0U);
  EXPECT_GT(tally.had_new, 0U) << "the sweep did not reach the end of a record";
}

TYPED_TEST(PowerCutOn, CutAfterCutNeverLosesASet) {
  constexpr std::uint32_t kSeed = 23;
  std::mt19937 random(kSeed);
  TypeParam flash;
  ParameterSet held = random_valid_set(random);
  ASSERT_TRUE(commit(flash, held));
  for (int i = 0; i < 3000; ++i) {
    const ParameterSet fresh = random_valid_set(random);
    flash.cut_power_after(random() % (2 * TypeParam::kSectorBytes), static_cast<Tear>(random() % 3),
                          random());
    const bool done = commit(flash, fresh);
    flash.restore_power();
    const Load loaded = load(flash);
    ASSERT_EQ(loaded.status, LoadStatus::loaded) << "cut " << i;
    ASSERT_TRUE(loaded.set == fresh || (!done && loaded.set == held)) << "cut " << i;
    held = loaded.set;
  }
  EXPECT_EQ(flash.misuses(), 0);
}

}  // namespace
}  // namespace astro
