#include "host/import/bags/time_order.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/import/bags/stamp_count.hpp"
#include "host/import/wheels/wheel_track.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::importing {
namespace {

using support::Tells;
using testing::ElementsAre;
using testing::IsEmpty;

/// Messages of a bag: stamped every `period_s`, and received as a link delays them.
struct SentMessages {
  std::vector<std::int64_t> stamps_ns, arrivals_ns;

  explicit SentMessages(double period_s, double longest_stall_s = 0, double skew = 0,
                        std::uint64_t seed = 1) {
    std::mt19937_64 random(seed);
    std::exponential_distribution<double> delay(1 / 0.004);
    std::uniform_real_distribution<double> even(0, 1);
    double open_s = 0, last_s = 0;
    for (double time_s = 0; time_s < 60; time_s += period_s) {
      if (time_s > open_s + 0.1) open_s = time_s + longest_stall_s * even(random);
      last_s = std::max({time_s + delay(random), longest_stall_s > 0 ? open_s : 0, last_s + 1e-5});
      stamps_ns.push_back(std::llround(1e9 * (1 + skew) * time_s));
      arrivals_ns.push_back(1'700'000'000'000'000'000 + std::llround(1e9 * last_s));
    }
  }

  void step(double from_s, double by_s) {
    const auto from = static_cast<std::size_t>(from_s / 60 * static_cast<double>(stamps_ns.size()));
    for (std::size_t i = from; i < stamps_ns.size(); ++i) stamps_ns[i] += std::llround(1e9 * by_s);
  }
  void lose(std::size_t from, std::size_t to) {
    for (auto* times : {&stamps_ns, &arrivals_ns})
      times->erase(times->begin() + static_cast<std::ptrdiff_t>(from),
                   times->begin() + static_cast<std::ptrdiff_t>(to));
  }
  std::vector<Remark> mend() {
    std::vector<Remark> remarks;
    take_clock_steps_back(stamps_ns, arrivals_ns, "/wheels", remarks);
    return remarks;
  }
};

TEST(StampSteps, AreFoundByTheArrivalsWhateverTheLinkDoes) {
  for (const double period_s : {0.005, 0.02, 0.1})
    for (const double stall_s : {0.0, 0.3})
      for (const double skew : {0.0, 3e-4, -3e-3})
        for (const double by_s : {0.1, -0.1, 0.5, -0.5, 3.0, -3.0, 3600.0}) {
          const SentMessages right(period_s, stall_s, skew);
          SentMessages sent = right;
          sent.step(24, by_s);
          const auto kind = by_s > 0 ? TimesRemark::clock_set_on : TimesRemark::clock_set_back;
          EXPECT_THAT(sent.mend(),
                      ElementsAre(Tells(kind, "/wheels", fmt::format("{:.2f}", std::abs(by_s)), testing::_)))
              << period_s << ' ' << stall_s << ' ' << skew << ' ' << by_s;
          EXPECT_NEAR(double(sent.stamps_ns.back() - right.stamps_ns.back()), 0, 1e6);
        }
}

TEST(StampSteps, SeveralAreEachTakenBack) {
  const SentMessages right(0.02);
  SentMessages sent = right;
  sent.step(10, 0.5);
  sent.step(20, -2);
  sent.step(40, 0.2);
  EXPECT_EQ(sent.mend().size(), 3U);
  for (std::size_t i = 0; i < right.stamps_ns.size(); ++i)
    EXPECT_NEAR(double(sent.stamps_ns[i] - right.stamps_ns[i]), 0, 1e6);
}

TEST(StampSteps, AreNoneWhereMessagesAreLostOrLate) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double stall_s : {0.0, 0.4, 1.5}) {
      SentMessages sent(0.02, stall_s, 1e-3, seed);
      sent.lose(1000, 1030);
      for (std::size_t i = 2000; i < sent.arrivals_ns.size(); ++i)
        sent.arrivals_ns[i] += 300'000'000;  // a recorder that falls behind
      const auto before = sent.stamps_ns;
      EXPECT_THAT(sent.mend(), IsEmpty());
      EXPECT_EQ(sent.stamps_ns, before);
    }
}

TEST(StampSteps, OfAClockThatIsSetOverAndOverLeaveTheArrivals) {
  SentMessages sent(0.02);
  for (int i = 1; i < 14; ++i) sent.step(4 * i, 0.3);
  EXPECT_THAT(sent.mend(), ElementsAre(Tells(TimesRemark::clock_set_often, "/wheels", "13")));
  EXPECT_EQ(sent.stamps_ns, sent.arrivals_ns);
}

TEST(StampSteps, NeedArrivalsThatTellMoreThanTheStamps) {
  for (const int kind : {0, 1, 2}) {
    SentMessages sent(0.02);
    sent.step(24, 0.5);
    if (kind == 0) sent.arrivals_ns.clear();
    if (kind == 1) sent.arrivals_ns = sent.stamps_ns;
    if (kind == 2) sent.arrivals_ns.assign(sent.stamps_ns.size(), 7);
    EXPECT_THAT(sent.mend(), IsEmpty()) << kind;
  }
}

/// What order_by_time makes of these messages.
struct Ordered {
  std::vector<WheelSample> samples;
  std::vector<Remark> remarks;
  bool stepped = false;

  explicit Ordered(const SentMessages& sent) {
    for (const std::int64_t stamp_ns : sent.stamps_ns) samples.push_back({stamp_ns, 0, 0});
    stepped = order_by_time(samples, sent.arrivals_ns, "drive.bag", "/wheels", remarks);
  }
};

TEST(StampSteps, SoonAfterTheBeginningAreNoSecondRecordingIfTheArrivalsShowIt) {
  for (const auto& [at_s, by_s] : {std::pair{4.4, -4.0}, {30.0, -29.0}}) {
    const SentMessages right(0.02);
    SentMessages sent = right;
    sent.step(at_s, by_s);
    const Ordered mended(sent);
    EXPECT_TRUE(mended.stepped);
    EXPECT_THAT(mended.remarks, ElementsAre(Tells(TimesRemark::clock_set_back, "/wheels",
                                                  fmt::format("{:.2f}", -by_s), testing::_)));
    ASSERT_EQ(mended.samples.size(), right.stamps_ns.size());
    for (std::size_t i = 0; i < right.stamps_ns.size(); ++i)
      EXPECT_NEAR(double(mended.samples[i].time_ns - right.stamps_ns[i]), 0, 1e6);
    sent.arrivals_ns.clear();
    EXPECT_THAT([&] { (void)Ordered(sent); },
                support::ThrowsTelling(StampProblem::begin_again, "drive.bag", "/wheels", testing::_));
  }
}

TEST(StampSteps, ThatFollowOneAnotherAreEachTakenBack) {
  const SentMessages right(0.02);
  SentMessages sent = right;
  sent.step(10, -0.5);
  sent.step(10.45, -0.5);
  const Ordered mended(sent);
  EXPECT_EQ(mended.remarks.size(), 2U);
  for (std::size_t i = 0; i < right.stamps_ns.size(); ++i)
    EXPECT_NEAR(double(mended.samples[i].time_ns - right.stamps_ns[i]), 0, 1e6);
}

TEST(StampSteps, AreNotReportedOfMessagesThatCameLate) {
  SentMessages sent(0.02);
  std::rotate(sent.stamps_ns.begin() + 500, sent.stamps_ns.begin() + 501, sent.stamps_ns.begin() + 650);
  const Ordered sorted(sent);
  EXPECT_FALSE(sorted.stepped);
  EXPECT_EQ(sorted.remarks.size(), 1U) << "only that they were sorted";
}

TEST(StampSteps, ARecordingThatWasStartedAgainSecondsLaterIsRefused) {
  SentMessages sent(0.02);
  sent.step(30, -30);
  for (std::size_t i = sent.arrivals_ns.size() / 2; i < sent.arrivals_ns.size(); ++i)
    sent.arrivals_ns[i] += 3'000'000'000;
  EXPECT_THAT([&] { (void)Ordered(sent); },
              support::ThrowsTelling(StampProblem::begin_again, "drive.bag", "/wheels", "30.0"));
}

TEST(StampSteps, TwoRecordingsInOneAreRefused) {
  std::vector<WheelSample> samples;
  for (int i = 0; i < 2000; ++i) samples.push_back({20'000'000LL * (i % 1000), 0, 0});
  std::vector<Remark> remarks;
  EXPECT_THAT([&] { order_by_time(samples, {}, "drive.bag", "/wheels", remarks); },
              support::ThrowsTelling(StampProblem::begin_again, "drive.bag", "/wheels", "20.0"));
}

}  // namespace
}  // namespace astro::importing
