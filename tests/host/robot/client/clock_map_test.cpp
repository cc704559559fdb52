#include "host/robot/client/clock_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace astro::robot {
namespace {

/// Two clocks and a line between them: each delay is a minimum plus an exponential part, independent for both
/// ways.
struct World {
  double drift = 0;
  std::uint64_t device_origin_us = 0;
  std::int64_t host_origin_us = 0;
  double least_there_us = 200, least_back_us = 200, mean_extra_us = 1000;
  std::mt19937_64 random{20240501};

  std::uint64_t device_at(double host_us) const {
    return device_origin_us + static_cast<std::uint64_t>(std::floor(host_us * (1 + drift)));
  }
  RoundTrip trip(double sent_us) {
    std::exponential_distribution<double> extra(1 / mean_extra_us);
    const double read_us = sent_us + least_there_us + extra(random);
    const double received_us = read_us + least_back_us + extra(random);
    return {host_origin_us + static_cast<std::int64_t>(sent_us), device_at(read_us),
            host_origin_us + static_cast<std::int64_t>(received_us)};
  }
  double error_us(const ClockMap& map, double host_us) const {
    return static_cast<double>(map.to_host(device_at(host_us))->us - host_origin_us) - host_us;
  }
};

TEST(ClockMap, KnowsNothingBeforeTheFirstRoundTrip) {
  EXPECT_FALSE(ClockMap().to_host(0));
  EXPECT_FALSE(ClockMap().drift());
}

TEST(ClockMap, OneRoundTripGivesTheMiddleAndHalfOfItAsTheBound) {
  ClockMap map;
  map.add({1000, 500, 1200});
  EXPECT_EQ(map.to_host(500)->us, 1100);
  EXPECT_NEAR(map.to_host(500)->bound_us, 100, 2);  // 2: both clocks count whole microseconds
  EXPECT_FALSE(map.drift());
}

/// A group of equal round trips, of which one is kept.
void add_group(ClockMap& map, std::int64_t sent_us, std::int64_t rtt_us) {
  const std::int64_t device_us = 7'000'000 + sent_us + rtt_us / 2;
  for (std::size_t i = 0; i < ClockMap::kGroup; ++i)
    map.add({sent_us, static_cast<std::uint64_t>(device_us), sent_us + rtt_us});
}

TEST(ClockMap, MeasuresADriftOverMoreThanTenTimesTheFastestRoundTripWhicheverThatIs) {
  struct Case {
    std::int64_t first_rtt_us, second_sent_us, second_rtt_us;
    bool measured;
  };
  for (const Case& one : {Case{100, 900, 100, false}, Case{100, 901, 100, true},     // 1000 and 1001 us
                          Case{100, 600, 400, false}, Case{100, 601, 400, true},     // the first is fastest
                          Case{400, 900, 100, false}, Case{400, 901, 100, true}}) {  // the last is
    ClockMap map;
    add_group(map, 0, one.first_rtt_us);
    add_group(map, one.second_sent_us, one.second_rtt_us);
    EXPECT_EQ(map.drift().has_value(), one.measured)
        << one.first_rtt_us << ' ' << one.second_sent_us << ' ' << one.second_rtt_us;
  }
}

TEST(ClockMap, NeverErrsMoreThanItsBoundWhateverTheDriftAndTheDelays) {
  for (const double drift : {-0.024, 0.0, 0.024}) {
    for (const double asymmetry_us : {0.0, 3000.0}) {
      World world;
      world.drift = drift;
      world.least_back_us += asymmetry_us;
      ClockMap map;
      for (int i = 0; i < 2000; ++i) {
        const double now_us = 50'000.0 * i;
        map.add(world.trip(now_us));
        for (const double ago_us : {0.0, 100'000.0, 1'000'000.0}) {
          if (ago_us > now_us) continue;
          const double bound = map.to_host(world.device_at(now_us - ago_us))->bound_us;
          ASSERT_LE(std::abs(world.error_us(map, now_us - ago_us)), bound)
              << "drift " << drift << " asymmetry " << asymmetry_us << " trip " << i << " ago " << ago_us;
        }
      }
    }
  }
}

TEST(ClockMap, MeasuresADriftOf24PerMille) {
  World world;
  world.drift = 0.024;
  ClockMap map;
  for (int i = 0; i < 600; ++i) map.add(world.trip(50'000.0 * i));
  ASSERT_TRUE(map.drift());
  // Half a round trip at the worst at both ends of 25 s would be 1.4 ms / 25 s.
  EXPECT_NEAR(*map.drift(), 0.024, 5.6e-5);
}

TEST(ClockMap, MapsBothWaysAlike) {
  ClockMap map;
  EXPECT_EQ(map.to_device(0), std::nullopt);
  constexpr std::int64_t kHost_us = 7'000'000'000;  // the host's clock when the robot's shows 0
  for (std::int64_t i = 0; i < 400; ++i) {
    const std::int64_t at_us = kHost_us + 50'000 * i;
    map.add({at_us,
             static_cast<std::uint64_t>(std::llround(1.02 * static_cast<double>(at_us + 200 - kHost_us))),
             at_us + 400});
    const std::int64_t device_us = *map.to_device(at_us);
    EXPECT_NEAR(static_cast<double>(map.to_host(static_cast<std::uint64_t>(device_us))->us - at_us), 0, 2)
        << i;
  }
}

TEST(ClockMap, BecomesMuchBetterThanASingleRoundTrip) {
  World world;
  world.drift = 0.024;
  ClockMap map;
  for (int i = 0; i < 600; ++i) map.add(world.trip(50'000.0 * i));
  // A single round trip of this line errs by 700 us rms; the fastest of eight in 64 groups, averaged, far
  // less.
  EXPECT_LT(std::abs(world.error_us(map, 30e6)), 200);
}

TEST(ClockMap, IsNotMisledByASlowRoundTripInEachGroup) {
  World world;
  world.mean_extra_us = 1;
  ClockMap map;
  for (int i = 0; i < 400; ++i) {
    world.least_back_us = i % 8 == 3 ? 40'000 : 200;
    map.add(world.trip(50'000.0 * i));
  }
  EXPECT_LT(std::abs(world.error_us(map, 20e6)), 10);
}

TEST(ClockMap, LosesNothingFarFromTheOriginAndDoesNotWrapAt32Bits) {
  for (const std::uint64_t origin : {std::uint64_t{0xFFFF'0000}, std::uint64_t{1} << 62}) {
    World near, far;
    near.drift = far.drift = 0.024;
    far.device_origin_us = origin;
    far.host_origin_us = std::int64_t{1} << 61;
    ClockMap a, b;
    for (int i = 0; i < 300; ++i) {
      a.add(near.trip(50'000.0 * i));
      b.add(far.trip(50'000.0 * i));
    }
    const auto from_a = *a.to_host(near.device_at(10e6));
    const auto from_b = *b.to_host(far.device_at(10e6));
    EXPECT_EQ(from_a.us, from_b.us - far.host_origin_us);
  }
}

TEST(ClockMap, FollowsASimulatorInFastMotion) {
  World world;
  world.drift = 299;  // 300 times as fast
  world.mean_extra_us = 20;
  ClockMap map;
  for (int i = 0; i < 200; ++i) map.add(world.trip(1'000.0 * i));
  EXPECT_LT(std::abs(world.error_us(map, 200e3)), 300);
  EXPECT_NEAR(*map.drift(), 299, 3);
}

TEST(ClockMap, BeginsAnewAfterReset) {
  ClockMap map;
  map.add({1000, 500, 1200});
  map.reset();
  EXPECT_FALSE(map.to_host(500));
}

}  // namespace
}  // namespace astro::robot
