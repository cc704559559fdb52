#include "hal/sim/encoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace astro::sim {
namespace {

TEST(Encoder, CountIsTheFloorOfTheAngle) {
  Encoder encoder;
  double angle = 0.0;
  for (const double step : {0.25, 0.5, 0.5, 2.0, -3.5, -0.5, -4.25, 1e5, -1e5, 0.0}) {  // all exact in binary
    angle += step;
    encoder.turn(step);
    EXPECT_EQ(encoder.count(), static_cast<std::int32_t>(std::floor(angle))) << angle;
  }
}

// A decoder that drops the fraction of each step would stand still here for ever.
TEST(Encoder, NoStepIsTooSmall) {
  Encoder encoder;
  for (int i = 0; i < 1 << 20; ++i) encoder.turn(0x1p-17);
  EXPECT_EQ(encoder.count(), 8);
  for (int i = 0; i < 1 << 20; ++i) encoder.turn(-0x1p-17);
  EXPECT_EQ(encoder.count(), 0);
}

TEST(Encoder, ManyRandomStepsAddUpToTheTotal) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> step(-90000, 100000);
    Encoder encoder;
    std::int64_t total = 0;  // in 2^-16 counts: exact
    for (int i = 0; i < 20000; ++i) {
      const int part = step(random);
      total += part;
      encoder.turn(part * 0x1p-16);
      ASSERT_EQ(encoder.count(), total >> 16) << "seed " << seed;
    }
  }
}

TEST(Encoder, WrapsAtBothEnds) {
  Encoder encoder;
  encoder.preset(std::numeric_limits<std::int32_t>::max());
  encoder.turn(1.0);
  EXPECT_EQ(encoder.count(), std::numeric_limits<std::int32_t>::min());
  encoder.turn(-1.0);
  EXPECT_EQ(encoder.count(), std::numeric_limits<std::int32_t>::max());
  encoder.turn(0x1p33 + 3.0);
  EXPECT_EQ(encoder.count(), std::numeric_limits<std::int32_t>::min() + 2)
      << "even by more than a whole round";
}

TEST(Encoders, OneWheelTurnIs2803CountsAndAFifth) {
  Encoders encoders(Config{});
  const double turn = 2.0 * std::numbers::pi;
  for (int i = 0; i < 5; ++i) encoders.turn({turn, -turn});
  // Rounding of pi may leave the angle a hair below the whole number of counts.
  EXPECT_NEAR(encoders.read().left, 14016, 1);
  EXPECT_NEAR(encoders.read().right, -14016, 1);
}

TEST(Encoders, UnpluggedOneStandsStill) {
  Encoders encoders(Config{});
  encoders.unplug(Side::left);
  encoders.turn({1.0, 1.0});
  EXPECT_EQ(encoders.read().left, 0);
  EXPECT_GT(encoders.read().right, 0);
  encoders.plug_in(Side::left);
  encoders.turn({1.0, 1.0});
  EXPECT_GT(encoders.read().left, 0);
}

TEST(Encoders, OneWithoutAChannelTogglesAndNeverGetsAnywhere) {
  Config config;
  config.wiring.left_channel_lost = true;
  Encoders encoders(config);
  std::int32_t least = 0, most = 0, changes = 0, last = encoders.read().left;
  for (int step = 0; step < 4000; ++step) {  // a count at a time, forward and then backward
    const double count = 2.0 * std::numbers::pi / 2803.2;
    encoders.turn({step < 3000 ? count : -count, count});
    const std::int32_t now = encoders.read().left;
    changes += now != last ? 1 : 0;
    last = now;
    least = std::min(least, now);
    most = std::max(most, now);
  }
  EXPECT_EQ(most - least, 1);
  EXPECT_NEAR(changes, 2000, 2) << "an edge every other count";
  EXPECT_NEAR(encoders.read().right, 4000, 1);
}

TEST(Encoders, AChannelThatIsLostOnTheWayLeavesTheCountWhereItWas) {
  Encoders encoders(Config{});
  encoders.turn({3.0, 3.0});
  const std::int32_t before = encoders.read().left;
  encoders.lose_channel(Side::left);
  EXPECT_EQ(encoders.read().left, before);
  encoders.turn({50.0, 50.0});
  EXPECT_LE(std::abs(encoders.read().left - before), 1);
  EXPECT_GT(encoders.read().right, before);
}

}  // namespace
}  // namespace astro::sim
