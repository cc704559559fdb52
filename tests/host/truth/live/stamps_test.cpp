#include "host/truth/live/stamps.hpp"

#include <gtest/gtest.h>

#include <random>

namespace astro::truth {
namespace {

constexpr std::int64_t kPeriod_us = 10'000;

std::vector<std::int64_t> even(std::size_t count) {
  std::vector<std::int64_t> times;
  for (std::size_t i = 0; i < count; ++i)
    times.push_back(5'000'000 + static_cast<std::int64_t>(i) * kPeriod_us);
  return times;
}

TEST(Regularity, OfEvenTimesIsWithoutJitter) {
  const Regularity regular = regularity_of(even(50));
  EXPECT_NEAR(regular.period_s, 0.01, 1e-12);
  EXPECT_NEAR(regular.jitter_s, 0, 1e-12);
}

TEST(Regularity, MissingFramesAreNoJitter) {
  std::vector<std::int64_t> times = even(100);
  for (const std::ptrdiff_t lost : {80, 41, 40, 39, 7}) times.erase(times.begin() + lost);
  const Regularity regular = regularity_of(times);
  EXPECT_NEAR(regular.period_s, 0.01, 1e-12);
  EXPECT_NEAR(regular.jitter_s, 0, 1e-12);
}

TEST(Regularity, BurstsAreJitterOfAboutThePeriod) {
  std::vector<std::int64_t> times;
  for (const std::int64_t time : even(80)) times.push_back(time / 40'000 * 40'000 + time % 40'000 / 100);
  const Regularity regular = regularity_of(times);
  EXPECT_NEAR(regular.period_s, 0.01, 0.0006) << "the last burst is not spread";
  EXPECT_GT(regular.jitter_s, 0.007);
  EXPECT_LT(regular.jitter_s, 0.011);
}

TEST(Regularity, IsThatOfTheNoiseInTheTimes) {
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  std::normal_distribution<double> noise_us(0, 300);
  std::vector<std::int64_t> times = even(400);
  for (std::int64_t& time : times) time += std::llround(noise_us(random));
  // An interval has the noise of two times. Of 400 the estimate is good to some 4 %.
  EXPECT_NEAR(regularity_of(times).jitter_s, 300e-6 * std::sqrt(2), 60e-6) << "seed " << kSeed;
}

TEST(Regularity, OfTimesThatDoNotPassIsNone) {
  EXPECT_EQ(regularity_of({}).period_s, 0);
  EXPECT_EQ(regularity_of(std::vector<std::int64_t>{7}).period_s, 0);
  EXPECT_EQ(regularity_of(std::vector<std::int64_t>(9, 7)).period_s, 0);
  EXPECT_EQ(regularity_of(std::vector<std::int64_t>{9, 8, 7}).period_s, 0);
}

/// Even frames of a sender whose clock began elsewhere, and their arrival 2 to 7 ms later.
std::vector<Stamp> sent_evenly(std::size_t count) {
  std::vector<Stamp> stamps;
  for (const std::int64_t time : even(count))
    stamps.push_back({1'700'000'000'000'000 + time, time + 2'000 + time / kPeriod_us * 7919 % 5'000});
  return stamps;
}

TEST(TrackerClock, TheSendersIsUsedIfItIsTheMoreRegularOne) {
  const auto stamps = sent_evenly(50);
  TrackerClock clock(stamps);
  EXPECT_TRUE(clock.is_senders());
  for (const Stamp& stamp : stamps) {
    const std::int64_t time_us = clock.host_time_us(stamp);
    EXPECT_LE(time_us, stamp.arrival_us);
    EXPECT_EQ(time_us - clock.host_time_us(stamps[0]), stamp.sender_us - stamps[0].sender_us);
  }
}

TEST(TrackerClock, TheArrivalIsUsedIfTheSenderStampsByAPolledClock) {
  std::vector<Stamp> stamps;
  for (const std::int64_t time : even(50))
    stamps.push_back({time / 16'000 * 16'000, time});  // a tick of 16 ms
  TrackerClock clock(stamps);
  EXPECT_FALSE(clock.is_senders());
  EXPECT_EQ(clock.host_time_us(stamps[9]), stamps[9].arrival_us);
}

TEST(TrackerClock, ASendersClockOfWholeMillisecondsIsUsedEvenIfTheFirstPosesArriveMoreEvenly) {
  std::vector<Stamp> stamps;
  for (std::int64_t i = 0; i < 50; ++i) stamps.push_back({(16'667 * i + 999) / 1'000 * 1'000, 16'667 * i});
  TrackerClock clock(stamps);
  EXPECT_GT(clock.sender().jitter_s, 10 * clock.arrival().jitter_s);
  EXPECT_TRUE(clock.is_senders());
}

TEST(TrackerClock, StampsThatCountSomethingElseThanMicrosecondsAreNotUsed) {
  for (const std::int64_t unit_us : {0, 1, 1'000'000}) {
    std::vector<Stamp> stamps = sent_evenly(50);
    for (std::size_t i = 0; i < stamps.size(); ++i)
      stamps[i].sender_us = unit_us * static_cast<std::int64_t>(i);
    EXPECT_FALSE(TrackerClock(stamps).is_senders()) << unit_us;
  }
}

TEST(TrackerClock, AJumpOfTheSendersClockIsMappedAnewSoThatTheTimesGoOn) {
  const auto stamps = sent_evenly(50);
  TrackerClock clock(stamps);
  Stamp later = stamps.back();
  for (const std::int64_t jump_us : {-3'600'000'000LL, -200'000LL, 200'000LL, 3'600'000'000LL}) {
    const std::int64_t time_us = clock.host_time_us(later);
    later.sender_us += jump_us + kPeriod_us;
    later.arrival_us += kPeriod_us;
    EXPECT_FALSE(clock.follows(later)) << jump_us;
    clock.continue_with({&later, 1});
    // The delays differ by up to 5 ms, and here there is one from which to tell the shortest.
    EXPECT_NEAR(static_cast<double>(clock.host_time_us(later) - time_us), kPeriod_us, 5'000) << jump_us;
  }
}

/// The same again, later and by another clock.
std::vector<Stamp> moved(std::vector<Stamp> stamps, std::int64_t later_us, std::int64_t jump_us) {
  for (Stamp& stamp : stamps) {
    stamp.sender_us += later_us + jump_us;
    stamp.arrival_us += later_us;
  }
  return stamps;
}

TEST(TrackerClock, AfterANewConnectionTheSendersClockMayBeAnyOther) {
  const auto stamps = sent_evenly(50);
  for (const std::int64_t jump_us : {-3'600'000'000LL, -5'000'000LL, -150'000LL, 5'000'000LL}) {
    TrackerClock clock(stamps);
    const std::int64_t time_us = clock.host_time_us(stamps[20]);
    clock.restart();
    const auto next = moved(stamps, 2'000'000, jump_us);
    EXPECT_TRUE(clock.follows(next[0])) << "whatever it is";
    clock.continue_with(next);
    EXPECT_EQ(clock.host_time_us(next[20]) - time_us, 2'000'000)
        << "the shortest delay is the same: " << jump_us;
  }
}

TEST(TrackerClock, AfterANewConnectionToTheSameClockTheMappingStays) {
  const auto stamps = sent_evenly(50);
  TrackerClock clock(stamps);
  const std::int64_t time_us = clock.host_time_us(stamps[20]);
  clock.restart();
  auto next = moved(stamps, 2'000'000, 0);
  for (Stamp& stamp : next) stamp.arrival_us += 40'000;  // the network is slower for a while
  clock.continue_with(next);
  EXPECT_EQ(clock.host_time_us(next[20]) - time_us, 2'000'000);
}

TEST(TrackerClock, ClocksThatDriftApartForHoursNeverJump) {
  for (const double ppm : {-200, -50, 50, 200}) {
    const auto stamps = sent_evenly(50);
    TrackerClock clock(stamps);
    for (std::int64_t i = 0; i < 720'000; ++i) {
      const std::int64_t passed_us = i * kPeriod_us;
      const auto drift_us = std::llround(1e-6 * ppm * static_cast<double>(passed_us));
      ASSERT_TRUE(clock.follows(moved({stamps.back()}, passed_us, drift_us).front())) << ppm << " ppm, " << i;
    }
    EXPECT_FALSE(
        clock.follows(moved({stamps.back()}, 7'200'000'000, std::llround(7'200 * ppm) + 150'000).front()))
        << "a jump is one all the same";
  }
}

TEST(TrackerClock, ANetworkThatHoldsSamplesBackDoesNotMoveTheirTimes) {
  const auto stamps = sent_evenly(50);
  TrackerClock clock(stamps);
  for (const std::int64_t late_us : {3'000'000, 15'000'000}) {
    Stamp late = stamps.back();
    const std::int64_t time_us = clock.host_time_us(late);
    late.arrival_us += late_us;
    EXPECT_TRUE(clock.follows(late));
    EXPECT_EQ(clock.host_time_us(late), time_us);
  }
}

}  // namespace
}  // namespace astro::truth
