#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/support/robots/hand_fed_drive.hpp"

// Each check that the robot makes by itself: its condition just inside and just outside the threshold, on one
// wheel at a time, and how long it must hold. The numbers are repeated here on purpose.
namespace astro {
namespace {

using support::fine_encoders;
using support::HandFedDrive;
using support::without_feedback;

constexpr int kPeriod_ms = 8;  // a slow check is made once in 8 ticks

/// Counts of fine encoders (78.8005 um each) that a wheel makes in one tick.
struct Wheel {
  const char* name;
  int left, right;
};
constexpr Wheel kWheels[] = {{"left", 1, 0}, {"right", 0, 1}, {"left back", -1, 0}, {"right back", 0, -1}};

/// Ticks from now to the fault; 0 if it does not come within two seconds.
int ticks_to(Fault fault, HandFedDrive& rig, const std::function<void()>& tick) {
  for (int i = 1; i <= 2'000; ++i) {
    tick();
    if (rig.has(fault)) return i;
  }
  return 0;
}

/// The shortest and the longest time for which a condition holds before it is found, over all phases of the
/// checks.
struct Span {
  int least = INT32_MAX, most = 0;
  void take(int ticks) {
    least = std::min(least, ticks);
    most = std::max(most, ticks);
  }
};

/// `begun(rig, phase)` makes a robot whose condition begins with the next tick, `phase` ticks later than with
/// phase 0; `tick(rig)` is a tick with the condition.
Span span_of(Fault fault, int phases, const std::function<HandFedDrive(int)>& begun,
             const std::function<void(HandFedDrive&)>& tick) {
  Span span;
  for (int phase = 0; phase < phases; ++phase) {
    HandFedDrive rig = begun(phase);
    EXPECT_EQ(rig.drive().faults().mask(), 0U) << phase;
    span.take(ticks_to(fault, rig, [&] { tick(rig); }));
  }
  return span;
}

/// Found by `hold_ms` at the latest, and not so early that a check would be missing.
void expect_hold(const Span& span, int hold_ms, int period_ms = kPeriod_ms) {
  EXPECT_EQ(span.most, hold_ms);
  EXPECT_EQ(span.least, hold_ms - period_ms + 1);
}

/// Driven by voltages, in open loop.
HandFedDrive driven(const ParameterSet& set, double left_V, double right_V, int phase = 0) {
  HandFedDrive rig(set);
  rig.ticks(phase);
  rig.arm();
  rig.voltages =
      WheelVoltages{static_cast<std::int32_t>(left_V * 1e6), static_cast<std::int32_t>(right_V * 1e6)};
  return rig;
}

// ---- the supply

TEST(SupplyWatch, FindsLessThanBatteryLowWhileTheMotorsHavePower) {
  ParameterSet set;
  set.set(Param::battery_low, 10'500);
  for (const int battery_mv : {10'500, 10'499}) {
    HandFedDrive rig = driven(set, 1, 1);
    rig.battery_mv = battery_mv;
    rig.ticks(200, 1, 1);
    EXPECT_EQ(rig.has(Fault::under_voltage), battery_mv == 10'499);
    HandFedDrive stands(set);
    stands.arm();
    stands.battery_mv = battery_mv;
    stands.ticks(500);
    EXPECT_FALSE(stands.has(Fault::under_voltage)) << "it may be carried home";
  }
}

TEST(SupplyWatch, FindsMoreThanBatteryHighInAnyState) {
  ParameterSet set;
  set.set(Param::battery_high, 14'000);
  for (const int battery_mv : {14'000, 14'001}) {
    HandFedDrive rig(set);
    rig.ticks(50);
    rig.battery_mv = battery_mv;
    rig.ticks(200);
    EXPECT_EQ(rig.has(Fault::over_voltage), battery_mv == 14'001);
  }
}

TEST(SupplyWatch, IsOffWhereTheThresholdIsZero) {
  ParameterSet set;
  set.set(Param::battery_low, 0);
  set.set(Param::battery_high, 0);
  for (const int battery_mv : {0, 1'000'000}) {
    HandFedDrive rig = driven(set, 0.1, 0.1);
    rig.battery_mv = battery_mv;
    rig.ticks(200, 1, 1);
    EXPECT_EQ(rig.drive().faults().mask(), 0U) << battery_mv;
  }
}

TEST(SupplyWatch, WaitsForAHundredMillisecondsOfTooLittle) {
  const auto low = [](HandFedDrive& rig) {
    rig.battery_mv = 5'000;
    rig.tick(1, 1);
  };
  expect_hold(span_of(
                  Fault::under_voltage, kPeriod_ms,
                  [](int phase) {
                    HandFedDrive rig = driven({}, 1, 1, phase);
                    rig.ticks(40, 1, 1);
                    return rig;
                  },
                  low),
              104);  // a hundred in rounds of eight
}

TEST(SupplyWatch, WaitsForTwentyFourMillisecondsOfTooMuch) {
  ParameterSet set;
  set.set(Param::battery_high, 14'000);
  const auto high = [](HandFedDrive& rig) {
    rig.battery_mv = 14'001;
    rig.tick();
  };
  expect_hold(span_of(
                  Fault::over_voltage, kPeriod_ms,
                  [&](int phase) {
                    HandFedDrive rig(set);
                    rig.ticks(50 + phase);
                    return rig;
                  },
                  high),
              24);
}

// ---- too fast

TEST(SpeedWatch, FindsOneWheelAboveOverSpeed) {
  for (const Wheel& wheel : kWheels) {
    const auto run = [&](std::int32_t over_speed_umps) {
      ParameterSet set;
      set.set(Param::over_speed, over_speed_umps);
      HandFedDrive rig(set);
      rig.ticks(50);
      rig.ticks(500, wheel.left * 14, wheel.right * 14);
      return rig;
    };
    const WheelSpeeds speeds = run(2'000'000).drive().wheels().speeds();
    const std::int32_t speed_umps = std::abs(speeds.left_umps + speeds.right_umps);  // one of them stands
    EXPECT_NEAR(speed_umps, 1'129'695, 50);  // 14 counts of 80.6925 um in a millisecond
    EXPECT_FALSE(run(speed_umps + 50).has(Fault::over_speed))
        << wheel.name;  // 50: the estimate's last digits
    EXPECT_TRUE(run(speed_umps - 50).has(Fault::over_speed)) << wheel.name;
  }
}

TEST(SpeedWatch, WaitsForTwentyFourMilliseconds) {
  const auto fast = [](HandFedDrive& rig) { rig.tick(20, 20); };
  Span span;
  for (int phase = 0; phase < kPeriod_ms; ++phase) {
    HandFedDrive rig;
    rig.ticks(50 + phase);
    while (rig.drive().wheels().speeds().left_umps <= 1'200'000) fast(rig);
    span.take(1 + ticks_to(Fault::over_speed, rig, [&] { fast(rig); }));  // 1: the tick before found it
  }
  expect_hold(span, 24);
}

// ---- a wheel that is pulled but has stopped: half of the usable voltage, 38 counts a tick are 2.99 mm/s, 39
// are 3.07

TEST(StallWatch, FindsOneWheelThatStandsUnderMoreThanHalfOfTheUsableVoltage) {
  for (const Wheel& wheel : kWheels)
    for (const double volts : {5.999, 6.001}) {
      HandFedDrive rig = driven(fine_encoders(), wheel.left * volts, wheel.right * volts);
      rig.ticks(1'000);
      EXPECT_EQ(rig.has(Fault::stall), volts == 6.001) << wheel.name << ' ' << volts;
    }
}

TEST(StallWatch, GoesByWhatTheMotorsMayGetOfTheSupply) {
  ParameterSet set = fine_encoders();
  set.set(Param::motor_voltage_max, 6'000);
  for (const Wheel& wheel : kWheels)
    for (const double volts : {2.999, 3.001}) {
      HandFedDrive rig = driven(set, wheel.left * volts, wheel.right * volts);
      rig.ticks(1'000);
      EXPECT_EQ(rig.has(Fault::stall), volts == 3.001) << wheel.name << ' ' << volts;
    }
}

TEST(StallWatch, TakesThreeMillimetresASecondForStanding) {
  for (const Wheel& wheel : kWheels)
    for (const int counts : {-39, -38, 38, 39}) {
      HandFedDrive rig = driven(fine_encoders(), wheel.left * 8, wheel.right * 8);
      rig.ticks(1'000, counts * std::abs(wheel.left), counts * std::abs(wheel.right));
      EXPECT_EQ(rig.has(Fault::stall), std::abs(counts) == 38) << wheel.name << ' ' << counts;
    }
}

TEST(StallWatch, WaitsForStallTime) {
  for (const int stall_ms : {200, 201}) {
    ParameterSet set;
    set.set(Param::stall_time, stall_ms);
    for (const Wheel& wheel : kWheels) {
      const Span span = span_of(
          Fault::stall, kPeriod_ms,
          [&](int phase) {
            HandFedDrive rig = driven(set, wheel.left * 8, wheel.right * 8, phase);
            rig.tick();  // the checks use the duty of the tick before
            return rig;
          },
          [](HandFedDrive& rig) { rig.tick(); });
      SCOPED_TRACE(wheel.name);
      expect_hold(span, (stall_ms + 7) / 8 * 8);
    }
  }
}

// ---- a wheel that turns against its motor: 39 counts of 1.2608 um in a tick are 49.2 mm/s, 40 are 50.4

/// A velocity without feedback from the counts; one wheel makes `counts` against it, the other follows it.
HandFedDrive against(const Wheel& wheel, double speed_mps, int counts, int ticks) {
  ParameterSet set;
  set.set(Param::counts_per_motor_rev, 4'096);
  HandFedDrive rig(without_feedback(set));
  rig.arm();
  const int sign = wheel.left + wheel.right;
  rig.velocity = BodyTwist{static_cast<std::int32_t>(sign * speed_mps * 1e6), 0};
  const int obeys = static_cast<int>(sign * speed_mps * 1e3 / 1.2608);
  const int turns = -sign * counts;
  rig.ticks(ticks, wheel.left != 0 ? turns : obeys, wheel.right != 0 ? turns : obeys);
  return rig;
}

TEST(RunawayWatch, FindsOneWheelThatTurnsFasterThanFiftyMillimetresASecondAgainstItsMotor) {
  for (const Wheel& wheel : kWheels)
    for (const int counts : {39, 40}) {
      const HandFedDrive rig = against(wheel, 0.6, counts, 1'500);
      EXPECT_EQ(rig.has(Fault::runaway), counts == 40) << wheel.name << ' ' << counts;
    }
}

TEST(RunawayWatch, LeavesAMotorAloneThatHardlyPulls) {
  for (const Wheel& wheel : kWheels)
    EXPECT_FALSE(against(wheel, 0.1, 60, 1'500).has(Fault::runaway)) << wheel.name;
}

TEST(RunawayWatch, LeavesWheelsAloneThatTurnAsTheirMotorsPull) {
  for (const Wheel& wheel : kWheels)
    EXPECT_FALSE(against(wheel, 0.6, -60, 1'500).has(Fault::runaway)) << wheel.name;
}

TEST(RunawayWatch, LooksOnlyWhereALoopDrives) {
  for (const Wheel& wheel : kWheels) {
    HandFedDrive rig = driven(fine_encoders(), wheel.left * 8, wheel.right * 8);
    rig.ticks(1'000, -800 * wheel.left, -800 * wheel.right);
    EXPECT_EQ(rig.drive().faults().mask(), 0U) << wheel.name;
  }
}

// ---- counts to and fro: four edges in 16 ms without travel

/// A wheel pulled by 8 V that makes so many edges to and fro in 16 ticks and ends `way` counts further.
/// Each wheel is checked every 16 ticks, so at each check there are `edges`, whatever the phase.
bool finds_dither(const Wheel& wheel, int edges, int way, double volts) {
  HandFedDrive rig = driven({}, wheel.left * volts, wheel.right * volts);
  for (int i = 0; i < 12; ++i)
    for (int at = 0; at < 16; ++at) {
      // The edges one by one, to and fro; the travel at once.
      const int counts = at < edges ? (at % 2 == 0 ? 1 : -1) : at == 12 ? way : 0;
      rig.tick(counts * std::abs(wheel.left), counts * std::abs(wheel.right));
    }
  return rig.has(Fault::encoder);
}

TEST(ChannelWatch, FindsFourEdgesWithoutAWayAndLeavesThreeAlone) {
  for (const Wheel& wheel : kWheels) {
    EXPECT_TRUE(finds_dither(wheel, 4, 0, 8)) << wheel.name;
    EXPECT_FALSE(finds_dither(wheel, 2, 0, 8)) << wheel.name;
    for (const int way : {-1, 1}) {  // the count that a single channel makes
      EXPECT_TRUE(finds_dither(wheel, 4, way, 8)) << wheel.name << ' ' << way;
      EXPECT_FALSE(finds_dither(wheel, 2, way, 8)) << wheel.name << ' ' << way << ": three edges";
    }
    for (const int way : {-2, 2}) EXPECT_FALSE(finds_dither(wheel, 4, way, 8)) << wheel.name << ' ' << way;
  }
}

TEST(ChannelWatch, LeavesAMotorAloneThatHardlyPulls) {
  for (const Wheel& wheel : kWheels) EXPECT_FALSE(finds_dither(wheel, 8, 0, 5.9)) << wheel.name;
}

TEST(ChannelWatch, LooksAtTheWheelThatPulls) {
  for (const Wheel& wheel : kWheels) {
    HandFedDrive rig = driven({}, wheel.left * 8, wheel.right * 8);
    for (int i = 0; i < 250; ++i)  // the other wheel goes to and fro; this one turns
      rig.tick(wheel.left != 0 ? wheel.left : (i % 2 == 0 ? 1 : -1),
               wheel.right != 0 ? wheel.right : (i % 2 == 0 ? 1 : -1));
    EXPECT_EQ(rig.drive().faults().mask(), 0U) << wheel.name;
  }
}

TEST(ChannelWatch, WaitsForFortyEightMilliseconds) {
  for (const Wheel& wheel : {kWheels[0], kWheels[1]}) {
    int step = 1;
    const auto dither = [&](HandFedDrive& rig) {
      step = -step;
      rig.tick(step * wheel.left, step * wheel.right);
    };
    // The condition begins while the wheel still turns, in the middle of 16 ms that may already count.
    const Span span = span_of(
        Fault::encoder, 2 * kPeriod_ms,
        [&](int phase) {
          HandFedDrive rig = driven({}, wheel.left * 8, wheel.right * 8, phase);
          rig.ticks(40, wheel.left, wheel.right);
          return rig;
        },
        dither);
    EXPECT_GT(span.least, 32) << wheel.name;
    EXPECT_LE(span.most, 48 + 16) << wheel.name;
    EXPECT_GE(span.most, 48) << wheel.name;
  }
}

// ---- a ramp whose wheels do not come to rest

TEST(StopWatch, WaitsForASecondOnceTheSetPointIsZero) {
  Span span;
  for (int phase = 0; phase < kPeriod_ms; ++phase) {
    HandFedDrive rig(without_feedback(fine_encoders()));
    rig.ticks(phase);
    rig.arm();
    rig.velocity = BodyTwist{1'000, 0};
    rig.ticks(150, 50, 50);
    rig.velocity.reset();
    rig.drive().stop();
    do rig.tick(50, 50);  // 3.9 mm/s: the wheels have not stopped
    while (rig.drive().wheels().set_points().left_umps != 0);
    span.take(ticks_to(Fault::stop_timeout, rig, [&] { rig.tick(50, 50); }));
  }
  EXPECT_EQ(span.least, 1'000);
  EXPECT_EQ(span.most, 1'000 + kPeriod_ms - 1);
}

// ---- the sign of life for the watchdog

TEST(Supervision, IsReportedOnceForEachTick) {
  HandFedDrive rig;
  EXPECT_FALSE(rig.drive().take_supervised());
  for (int i = 0; i < 3; ++i) {
    rig.tick();
    EXPECT_TRUE(rig.drive().take_supervised());
    EXPECT_FALSE(rig.drive().take_supervised());
  }
}

// ---- gains that change amid a ramp

TEST(GainsChangedAmidARamp, LeaveTheDutyWhereItIs) {
  HandFedDrive rig(fine_encoders());
  rig.arm();
  rig.velocity = BodyTwist{700'000, 0};
  const auto obey = [&] {  // the wheels follow their set points
    const WheelSpeeds& told = rig.drive().wheels().set_points();
    return rig.tick(static_cast<int>(told.left_umps / support::kFineCount_umps),
                    static_cast<int>(told.right_umps / support::kFineCount_umps));
  };
  int duty = 0;
  while (rig.drive().wheels().set_points().left_umps < 60'000) duty = obey().duty.left;  // amid the ramp
  const int step = obey().duty.left - duty;
  duty += step;
  ParameterSet other = fine_encoders();
  other.set(Param::kA_left, 3 * other.get(Param::kA_left));
  rig.drive().configure(other);
  EXPECT_NEAR(obey().duty.left, duty + step, 100) << "of 32767; three times kA alone would be 3000 more";
  EXPECT_EQ(rig.drive().faults().mask(), 0U);
}

// ---- after a fault was cleared every check starts again

/// Causes the fault, clears it while its cause continues, and drives again at once.
template <class Tick>
int ticks_to_the_same_fault_again(Fault fault, HandFedDrive& rig, const Tick& tick) {
  EXPECT_NE(ticks_to(fault, rig, [&] { tick(rig); }), 0);
  EXPECT_TRUE(rig.drive().clear_faults());
  EXPECT_EQ(rig.drive().faults().mask(), 0U);
  rig.drive().arm();
  return ticks_to(fault, rig, [&] { tick(rig); });
}

TEST(ClearedFault, ComesAgainOnlyAfterItsTimeIfItsCauseStayed) {
  ParameterSet set;
  set.set(Param::battery_high, 14'000);
  HandFedDrive high(set);
  high.ticks(50);
  high.battery_mv = 15'000;
  EXPECT_GT(ticks_to_the_same_fault_again(Fault::over_voltage, high, [](HandFedDrive& rig) { rig.tick(); }),
            16);

  HandFedDrive low = driven({}, 1, 1);
  low.battery_mv = 5'000;
  EXPECT_GT(
      ticks_to_the_same_fault_again(Fault::under_voltage, low, [](HandFedDrive& rig) { rig.tick(1, 1); }),
      96);

  HandFedDrive fast;
  fast.ticks(50);
  EXPECT_GT(
      ticks_to_the_same_fault_again(Fault::over_speed, fast, [](HandFedDrive& rig) { rig.tick(20, 20); }),
      16);

  for (const Wheel& wheel : kWheels) {
    HandFedDrive stands = driven({}, wheel.left * 8, wheel.right * 8);
    EXPECT_GT(ticks_to_the_same_fault_again(Fault::stall, stands, [](HandFedDrive& rig) { rig.tick(); }), 190)
        << wheel.name;
  }
}

// ---- the start

TEST(Boot, IsOverAfterThirtyTwoTicksOnTime) {
  const auto ticks_of_boot = [](int late_at) {
    HandFedDrive rig;
    int ticks = 0;
    for (; rig.drive().state() == State::boot && ticks < 1'000; ++ticks) {
      rig.on_time = ticks != late_at;
      rig.tick();
    }
    return ticks;
  };
  EXPECT_NEAR(ticks_of_boot(-1), 32, kPeriod_ms - 1);
  EXPECT_NEAR(ticks_of_boot(20), 20 + 32, kPeriod_ms) << "a late tick begins it anew";
}

}  // namespace
}  // namespace astro
