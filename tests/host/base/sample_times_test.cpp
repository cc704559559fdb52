#include "host/base/sample_times.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/base/remarks.hpp"

namespace astro {
namespace {

using support::Tells;
using testing::ElementsAre;
using testing::IsEmpty;
using Times = std::vector<std::int64_t>;

constexpr std::int64_t kPeriod_ns = 10'000'000;

Times steady(std::size_t count, std::int64_t period_ns = kPeriod_ns) {
  Times times;
  for (std::size_t i = 0; i < count; ++i) times.push_back(5'000'000'000 + std::int64_t(i) * period_ns);
  return times;
}

/// The remarks on these times, which are mended.
std::vector<Remark> mend(Times& times) {
  std::vector<Remark> remarks;
  mend_times(times, "the wheels", remarks);
  return remarks;
}

TEST(SampleTimes, OfASteadyClockWithJitterAndGapsStayAsTheyAre) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> jitter(-kPeriod_ns / 3, kPeriod_ns / 3);
  Times times = steady(1000);
  for (std::int64_t& time : times) time += jitter(random);
  for (std::size_t i = 600; i < 1000; ++i) times[i] += 3'000'000'000;
  const Times before = times;
  EXPECT_THAT(mend(times), IsEmpty());
  EXPECT_EQ(times, before);
}

TEST(SampleTimes, OfAClockThatIsSetBackGoOn) {
  Times times = steady(1000);
  const Times right = times;
  for (std::size_t i = 400; i < 1000; ++i) times[i] -= 500'000'000;
  for (std::size_t i = 700; i < 1000; ++i) times[i] -= 200'000'000;
  EXPECT_THAT(mend(times), ElementsAre(Tells(TimesRemark::clock_set_back, "the wheels", "0.50", "4.0"),
                                       Tells(TimesRemark::clock_set_back, "the wheels", "0.20", "7.0")));
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(double(times[i]), double(right[i]), 0.01 * kPeriod_ns);  // the period is found from the data
}

TEST(SampleTimes, OfAClockThatIsSetBackTwiceWithinASecondGoOn) {
  Times times = steady(1000);
  const Times right = times;
  for (std::size_t i = 400; i < 1000; ++i) times[i] -= 500'000'000;
  for (std::size_t i = 445; i < 1000; ++i) times[i] -= 500'000'000;
  EXPECT_EQ(mend(times).size(), 2U);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(double(times[i]), double(right[i]), 0.01 * kPeriod_ns);  // the period is found from the data
}

TEST(SampleTimes, OfTwoRecordingsInOneAreNotJoined) {
  for (const auto& [first, second] :
       {std::pair<std::size_t, std::size_t>{1000, 1000}, {400, 1000}, {1000, 400}}) {
    Times times = steady(first);
    for (const std::int64_t time : steady(second)) times.push_back(time + kPeriod_ns / 3);
    const Times before = times;
    EXPECT_THAT(mend(times), IsEmpty());
    EXPECT_EQ(times, before);
    EXPECT_EQ(second_recording(times), first);
  }
  EXPECT_FALSE(second_recording(steady(1000)));
}

TEST(SampleTimes, OfAClockThatIsSetBackOverAndOverStayAsTheyAre) {
  Times times = steady(4000);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] -= 100'000'000 * std::int64_t(i / 300);
  const Times before = times;
  EXPECT_THAT(mend(times), IsEmpty());
  EXPECT_EQ(times, before);
}

TEST(SampleTimes, ThatAreSetOnBeyondAllNumbersStayAsTheyAre) {
  constexpr std::int64_t kYear_ns = 31'557'600'000'000'000;
  Times times;
  for (std::int64_t from = -60; from < 60; from += 18)
    for (std::int64_t year = from; year < 60; ++year) times.push_back(year * kYear_ns);
  const Times before = times;
  EXPECT_THAT(mend(times), IsEmpty());
  EXPECT_EQ(times, before);
}

TEST(SampleTimes, OutOfOrderAreNotTakenForAnotherClock) {
  Times times = steady(1000);
  std::swap(times[100], times[101]);                                           // two that overtook each other
  std::rotate(times.begin() + 300, times.begin() + 301, times.begin() + 320);  // one that came late
  std::rotate(times.begin() + 500, times.begin() + 600,
              times.begin() + 700);  // a chunk that was written later
  const Times before = times;
  EXPECT_THAT(mend(times), IsEmpty());
  EXPECT_EQ(times, before);
}

TEST(SampleTimes, InBurstsAreEvenedOutToTheLeastDelay) {
  Times times = steady(2000);
  const Times right = times;
  std::mt19937_64 random(2);
  std::uniform_int_distribution<std::int64_t> stall(0, 360'000'000);
  std::int64_t open_ns = 0, last_ns = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] > open_ns + 100'000'000) open_ns = times[i] + stall(random);
    last_ns = times[i] = std::max({times[i], open_ns, last_ns + 300'000});
  }
  const auto remarks = mend(times);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks[0].kind, Kind(TimesRemark::bursts_evened));
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(double(times[i]), double(right[i]), 0.5 * kPeriod_ns) << i;
}

TEST(SampleTimes, OfNobodyAreNotMended) {
  for (Times times :
       {Times{}, Times{1}, Times{3, 2, 1}, Times(100, 7),
        Times{std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}})
    EXPECT_THAT(mend(times), IsEmpty());
  Times wild = steady(100);
  wild[50] = std::numeric_limits<std::int64_t>::min();
  EXPECT_THAT(mend(wild), IsEmpty());
}

}  // namespace
}  // namespace astro
