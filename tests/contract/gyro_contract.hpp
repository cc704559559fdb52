#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "tests/contract/rig.hpp"

/// The optional gyro, as hal/interface/board.hpp promises it.
namespace astro::contract {

/// A rig whose board has a gyro.
template <class T>
concept GyroRig = Rig<T> && requires(T& rig, double rate_radps, bool plugged) {
  requires hal::HasGyro<std::remove_reference_t<decltype(rig.board())>>;
  rig.turn_body(rate_radps);  // counter-clockwise, for as long as time goes by
  rig.plug_gyro(plugged);
  { rig.up() } -> std::same_as<std::size_t>;  // the sensor's axis that points up
};

template <GyroRig R>
class GyroContract : public testing::Test {
 protected:
  using State = hal::GyroReading::State;

  hal::GyroReading read() { return rig.board().gyro().read(); }
  /// As a control tick does: once in a millisecond.
  hal::GyroReading after_ms(int ms) {
    hal::GyroReading reading;
    for (int i = 0; i < ms; ++i) {
      rig.pass_ms(1);
      reading = read();
    }
    return reading;
  }
  /// Reads until the board says so of its gyro, for so long at most.
  State until(State state, int at_most_ms) {
    State now = read().state;
    for (int ms = 0; now != state && ms < at_most_ms; ++ms) now = after_ms(1).state;
    return now;
  }
  /// A gyro that measures, and of whose start nothing is left in its low pass.
  void start() {
    until(State::running, 500);
    after_ms(kSettles_ms);
  }
  static constexpr int kSettles_ms = 40;  // eight times the slowest low pass

  double rate_radps(const hal::GyroReading& reading, std::size_t axis) const {
    return reading.rate[axis] * 1e-9 * reading.count_nradps;
  }
  R rig;
};
TYPED_TEST_SUITE_P(GyroContract);

TYPED_TEST_P(GyroContract, RunsWithinHalfASecond) {
  EXPECT_EQ(this->until(hal::GyroReading::State::running, 500), hal::GyroReading::State::running);
}

TYPED_TEST_P(GyroContract, SaysTheRateAboutItsOwnAxes) {
  this->start();
  for (const double rate_radps : {0.0, -2.0, 8.0}) {
    this->rig.turn_body(rate_radps);
    this->after_ms(this->kSettles_ms);
    double sum[3] = {};
    constexpr int kSamples = 20;
    for (int i = 0; i < kSamples; ++i) {
      const hal::GyroReading reading = this->after_ms(5);
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += this->rate_radps(reading, axis) / kSamples;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // A sensor's offset at rest is at most 0.06 rad/s, its scale good to 1 % as it comes from its maker.
      const double expected = axis == this->rig.up() ? rate_radps : 0;
      EXPECT_NEAR(sum[axis], expected, 0.06 + 0.01 * std::abs(expected)) << axis;
    }
  }
}

TYPED_TEST_P(GyroContract, SaturatesWithoutWrapping) {
  this->start();
  for (const double rate_radps : {30.0, -30.0}) {
    this->rig.turn_body(rate_radps);
    const int counts = this->after_ms(this->kSettles_ms).rate[this->rig.up()];
    EXPECT_GE(rate_radps > 0 ? counts : -counts, hal::GyroReading::kSaturated);
  }
}

TYPED_TEST_P(GyroContract, EachSampleHasANumberOfItsOwnAndComesOften) {
  this->start();
  std::uint32_t last = this->read().number;
  int samples = 0;
  for (int ms = 0; ms < 200; ++ms) {
    const hal::GyroReading reading = this->after_ms(1);
    EXPECT_LE(reading.number - last, 1U);
    samples += reading.number != last ? 1 : 0;
    last = reading.number;
  }
  EXPECT_GE(samples, 20) << "100 samples a second or more";
}

TYPED_TEST_P(GyroContract, AGyroThatIsUnpluggedStopsRunningAndComesBack) {
  this->start();
  this->rig.plug_gyro(false);
  EXPECT_EQ(this->until(hal::GyroReading::State::failed, 500), hal::GyroReading::State::failed);
  this->rig.plug_gyro(true);
  EXPECT_EQ(this->until(hal::GyroReading::State::running, 3000), hal::GyroReading::State::running);
}

TYPED_TEST_P(GyroContract, ABoardWhoseGyroIsNotThereSaysSo) {
  this->rig.plug_gyro(false);
  this->rig.restarted_id();
  EXPECT_EQ(this->after_ms(500).state, hal::GyroReading::State::absent);
}

REGISTER_TYPED_TEST_SUITE_P(GyroContract, RunsWithinHalfASecond, SaysTheRateAboutItsOwnAxes,
                            SaturatesWithoutWrapping, EachSampleHasANumberOfItsOwnAndComesOften,
                            AGyroThatIsUnpluggedStopsRunningAndComesBack, ABoardWhoseGyroIsNotThereSaysSo);

}  // namespace astro::contract
