#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <vector>

#include "tests/common/params/store_on.hpp"
#include "tests/support/base/thorough.hpp"

/// The power fails after every byte of each of 1,000 random commits (each time: 100) on sectors like the reference robot's.
///
/// More than a million cuts, each of them tried: what they share is done once, and nothing is sampled.
///   * A commit's calls are recorded once and repeated up to each cut. Before the cut the commit reads the
///   same
///     as without one, so it makes the same calls; after the cut the flash does not change.
///   * A commit works on one sector only (asserted). load() returns the newest over all sectors and searches
///   each
///     separately, so the other sectors are searched once for all cuts of a commit.
///   * A cut that leaves the same bytes as the one before has the same outcome.
/// At every 4,999th cut the whole commit is run and cut, and the whole flash loaded, with the same result.
namespace astro {
namespace {

using sim::Tear;
using support::random_valid_set;
using Flash = sim::SimulatedFlash<4, 4096, 8>;
constexpr std::uint32_t kSectorBytes = Flash::kSectorBytes;

/// A flash that records the calls.
struct Recorder {
  static constexpr std::uint32_t kSectors = Flash::kSectors, kSectorBytes = Flash::kSectorBytes,
                                 kProgramBytes = Flash::kProgramBytes;
  struct Call {
    std::uint32_t sector, at;
    std::vector<std::uint8_t> bytes;  // none: erase
  };
  Flash& flash;
  std::vector<Call> calls{};

  bool erase(std::uint32_t sector) noexcept {
    calls.push_back({sector, 0, {}});
    return flash.erase(sector);
  }
  bool program(std::uint32_t at, std::span<const std::uint8_t> bytes) noexcept {
    calls.push_back({at / kSectorBytes, at, {bytes.begin(), bytes.end()}});
    return flash.program(at, bytes);
  }
  void read(std::uint32_t at, std::span<std::uint8_t> into) noexcept { flash.read(at, into); }
};

/// One sector of a flash, by itself.
struct OneSector {
  static constexpr std::uint32_t kSectors = 1, kSectorBytes = Flash::kSectorBytes,
                                 kProgramBytes = Flash::kProgramBytes;
  Flash& flash;
  std::uint32_t sector;

  bool erase(std::uint32_t) noexcept { return false; }
  bool program(std::uint32_t, std::span<const std::uint8_t>) noexcept { return false; }
  void read(std::uint32_t at, std::span<std::uint8_t> into) noexcept {
    flash.read(sector * kSectorBytes + at, into);
  }
};

struct Found {
  bool any = false;
  std::uint32_t sequence = 0;
  ParameterSet set;
};

/// The newer of the set found so far and the sector's set.
void look(Flash& flash, std::uint32_t sector, Found& found) {
  OneSector view{flash, sector};
  Record record;
  const auto newest = RecordLog<OneSector>(view).newest(record);
  if (!newest.found) return;
  if (found.any && static_cast<std::int32_t>(newest.sequence - found.sequence) <= 0) return;
  found = {true, newest.sequence, record.set()};
}

class ThousandCommits : public ::testing::TestWithParam<Tear> {
 protected:
  static constexpr std::uint32_t kSeed = 42;
  using Sector = std::vector<std::uint8_t>;

  Sector sector_of(const Flash& flash, std::uint32_t sector) {
    const auto bytes = flash.content().subspan(sector * kSectorBytes, kSectorBytes);
    return {bytes.begin(), bytes.end()};
  }

  void repeat_calls(Flash& flash, const std::vector<Recorder::Call>& calls) {
    for (const auto& [sector, at, bytes] : calls)
      static_cast<void>(bytes.empty() ? flash.erase(sector) : flash.program(at, bytes));
  }

  void check_the_long_way(const Flash& before, std::uint64_t cut, std::uint64_t seed,
                          const ParameterSet& fresh, Flash& shortened) {
    Flash whole = before;
    whole.cut_power_after(cut, GetParam(), seed);
    const bool done = support::commit(whole, fresh);
    ASSERT_TRUE(!done || outcome.set == fresh) << "promised, and not there";
    whole.restore_power();
    ASSERT_TRUE(std::ranges::equal(whole.content(), shortened.content()));
    ASSERT_EQ(support::load(whole).set, outcome.set);
    ++long_ways;
  }

  /// All cuts of the commit of `fresh` over `old`, which `before` holds.
  void cut_everywhere(const Flash& before, const ParameterSet& old, const ParameterSet& fresh) {
    Flash trial = before;
    Recorder recorder{trial};
    Store<Recorder> store(recorder);
    const std::uint64_t begun = trial.bytes_worked();
    ASSERT_TRUE(store.commit(fresh));
    const std::uint64_t work = trial.bytes_worked() - begun;
    const std::uint32_t sector = recorder.calls.front().sector;
    for (const auto& call : recorder.calls) ASSERT_EQ(call.sector, sector);
    Found others;
    for (std::uint32_t other = 0; other < Flash::kSectors; ++other)
      if (other != sector) look(trial, other, others);
    const Sector clean = sector_of(before, sector);
    Sector last;
    for (std::uint64_t cut = 0; cut <= work; ++cut) {
      trial.put_back(sector * kSectorBytes, clean);
      trial.cut_power_after(cut, GetParam(), cuts);
      repeat_calls(trial, recorder.calls);
      ASSERT_FALSE(trial.powered());
      trial.restore_power();
      ++cuts;
      const auto* now = trial.content().data() + std::size_t{sector} * kSectorBytes;
      if (last.empty() || std::memcmp(last.data(), now, kSectorBytes) != 0) {
        outcome = others;
        look(trial, sector, outcome);
        ++contents;
        last.assign(now, now + kSectorBytes);
      }
      if (!(outcome.set == old || outcome.set == fresh)) ++lost;
      ASSERT_EQ(lost, 0U) << "cut after " << cut << " bytes of " << work;
      ++(outcome.set == old ? kept_old : had_new);
      if (cuts % 4999 == 0) check_the_long_way(before, cut, cuts - 1, fresh, trial);
      if (HasFatalFailure()) return;
    }
  }

  Found outcome;
  std::uint64_t cuts = 0, contents = 0, kept_old = 0, had_new = 0, lost = 0, long_ways = 0;
};

TEST_P(ThousandCommits, CutAfterEveryByteLoseNoSet) {
  std::mt19937 random(kSeed);
  Flash flash;
  ParameterSet old = random_valid_set(random);
  ASSERT_TRUE(support::commit(flash, old));
  const int commits = support::how_often(100, 1000);
  for (int i = 0; i < commits; ++i) {
    const ParameterSet fresh = random_valid_set(random);
    cut_everywhere(flash, old, fresh);
    ASSERT_FALSE(HasFatalFailure()) << "commit " << i;
    ASSERT_TRUE(support::commit(flash, fresh));
    old = fresh;
  }
  std::printf(
      "seed %u, %d commits, %llu cuts (%llu different contents): %llu times the old set, %llu times the "
      "new one, %llu lost sets; %llu cuts the long way\n",
      kSeed, commits, static_cast<unsigned long long>(cuts), static_cast<unsigned long long>(contents),
      static_cast<unsigned long long>(kept_old), static_cast<unsigned long long>(had_new),
      static_cast<unsigned long long>(lost), static_cast<unsigned long long>(long_ways));
  EXPECT_EQ(lost, 0U);
  EXPECT_GE(had_new, static_cast<std::uint64_t>(commits));
}

INSTANTIATE_TEST_SUITE_P(Sharp, ThousandCommits, testing::Values(Tear::sharp));
INSTANTIATE_TEST_SUITE_P(Torn, ThousandCommits, testing::Values(Tear::torn));

}  // namespace
}  // namespace astro
