#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <string_view>

#include "tests/support/robots/drive_rig.hpp"

// Every fault that the robot checks for, provoked in every state: the bridges are open within the time that
// is given here, and nothing moves again by itself.
namespace astro {
namespace {

using protocol::Mode;
using support::DriveRig;

constexpr std::int32_t kWeak_16 = 5 << 16;  // Vs/m: too little to hold the robot on a slope

struct Cause {
  Fault fault;
  std::function<void(DriveRig&)> provoke;
  /// From now on the condition of the fault holds.
  std::function<bool(DriveRig&)> holds;
  const char* which = "";  // of several causes of one fault
};

const std::vector<Cause> kCauses{
    {Fault::driver, [](DriveRig& rig) { rig.board().motors().set_fault(true); },
     [](DriveRig&) { return true; }},
    {Fault::under_voltage, [](DriveRig& rig) { rig.board().battery().set_open_circuit_V(9); },
     [](DriveRig& rig) { return rig.board().battery().millivolts() < 10'500; }},
    {Fault::over_voltage, [](DriveRig& rig) { rig.board().battery().set_open_circuit_V(16); },
     [](DriveRig& rig) { return rig.board().battery().millivolts() > 14'000; }},
    {Fault::over_speed,
     [](DriveRig& rig) { rig.board().set_load(Side::left, {.torque_Nm = 20}); },  // down a cliff
     [](DriveRig& rig) { return rig.drive().wheels().speeds().left_umps > 1'200'000; }},
    {Fault::stall, [](DriveRig& rig) { rig.board().set_load(Side::right, {.drag_Nm = 100}); },
     [](DriveRig& rig) {
       return std::abs(rig.drive().wheels().forward_duty().right) > 16'383 &&
              std::abs(rig.drive().wheels().speeds().right_umps) <= 3'000;
     }},
    {Fault::encoder,
     [](DriveRig& rig) {
       const hal::EncoderCounts now = rig.board().encoders().read();
       rig.board().encoders().preset({now.left, now.right - 50'000});
     },
     [](DriveRig&) { return true; }},
    {Fault::encoder, [](DriveRig& rig) { rig.board().encoders().lose_channel(Side::left); },
     [](DriveRig& rig) {  // the wheel really turns, and the motor pulls
       return std::abs(rig.drive().wheels().forward_duty().left) > 16'383 && std::abs(rig.left_mps()) > 0.05;
     },
     "channel_"},
    {Fault::tick_overrun, [](DriveRig& rig) { rig.late_ticks = 1; }, [](DriveRig&) { return true; }},
    {Fault::runaway, [](DriveRig& rig) { rig.reverse_left_encoder(); },
     [](DriveRig& rig) {
       const std::int32_t duty = rig.drive().wheels().forward_duty().left;
       const std::int32_t speed_umps = rig.drive().wheels().speeds().left_umps;
       return std::abs(duty) > 16'383 && std::abs(speed_umps) > 50'000 && (duty < 0) != (speed_umps < 0);
     }},
    {Fault::command_timeout, [](DriveRig& rig) { rig.release(); }, [](DriveRig&) { return true; }},
    {Fault::link_lost, [](DriveRig& rig) { rig.silent = true; }, [](DriveRig&) { return true; }},
    {Fault::stop_timeout,
     [](DriveRig& rig) {  // gains may change while the robot drives; these cannot hold it on the slope
       ParameterSet weak;
       weak.set(Param::kp, kWeak_16);
       weak.set(Param::ki, 0);
       rig.drive().configure(weak);
       for (const Side side : {Side::left, Side::right}) rig.board().set_load(side, {.torque_Nm = 0.25});
     },
     [](DriveRig& rig) {
       return rig.drive().mode() == Mode::stopping && rig.drive().wheels().set_points() == WheelSpeeds{};
     }},
};

struct Situation {
  const char* name;
  Mode mode;
  std::function<void(DriveRig&)> enter;
};

void drive_line(DriveRig& rig) {
  rig.add({.length_nm = 20'000'000'000, .speed_umps = 300'000});
  rig.run_ms(1500);
}

const std::vector<Situation> kSituations{
    {"boot", Mode::boot, [](DriveRig& rig) { rig.restart(); }},
    {"disarmed", Mode::disarmed, [](DriveRig& rig) { rig.drive().disarm(); }},
    {"armed", Mode::idle, [](DriveRig&) {}},
    {"velocity", Mode::velocity,
     [](DriveRig& rig) {
       rig.hold_velocity(0.3, 0.2);
       rig.run_ms(1500);
     }},
    {"segment", Mode::segment, drive_line},
    {"voltages", Mode::wheels,
     [](DriveRig& rig) {
       rig.hold_voltages({7'000'000, 7'000'000});
       rig.run_ms(1000);
     }},
    {"stopping", Mode::stopping,
     [](DriveRig& rig) {
       drive_line(rig);
       rig.drive().stop();
       rig.run_ms(20);
     }},
    {"paused", Mode::paused,
     [](DriveRig& rig) {
       drive_line(rig);
       rig.drive().pause();
       rig.run_ms(2000);
     }},
};

// ---- What must happen, written here and not taken from the table under test.

// Milliseconds from the condition to open bridges: the hold time plus the longest wait for a slow check.
constexpr int kLate = 8 + 1;
constexpr int kNot = 0;  // not checked in this situation
constexpr int kTick = 1;
constexpr int kLow = 100 + kLate;         // supply
constexpr int kHigh = 24 + kLate;         // supply or speed
constexpr int kStall = 300 + 8 + kLate;   // stall_time, and the delay of the speed observer
constexpr int kChannel = 48 + 4 * kLate;  // each wheel in every second round, from one visit to the next
constexpr int kAway = 48 + kLate;
constexpr int kHost = 200 + kLate;   // command_timeout
constexpr int kRamp = kHost + 2500;  // and the longest ramp after it
constexpr int kGone = 2496 + kLate;  // the longest silence while the robot stops or is armed at rest
constexpr int kRest = 1001 + kLate;  // from a set point of zero, a tick before the ramp has arrived

struct Expectation {
  Fault fault;
  std::string_view which;
  std::array<int, 8> open_ms;
};

// clang-format off
constexpr std::array kExpectations{
    //                                             boot   disarmed armed  velocity  segment   voltages
    //                                                    stopping  paused
    Expectation{Fault::driver,          "",         {kNot,  kNot,  kTick, kTick,    kTick,    kTick,    kTick,    kTick}},
    Expectation{Fault::under_voltage,   "",         {kNot,  kNot,  kNot,  kLow,     kLow,     kLow,     kLow,     kNot}},
    Expectation{Fault::over_voltage,    "",         {kHigh, kHigh, kHigh, kHigh,    kHigh,    kHigh,    kHigh,    kHigh}},
    Expectation{Fault::over_speed,      "",         {kHigh, kHigh, kHigh, kHigh,    kHigh,    kHigh,    kHigh,    kHigh}},
    Expectation{Fault::stall,           "",         {kNot,  kNot,  kNot,  kStall,   kStall,   kStall,   kStall,   kNot}},
    Expectation{Fault::encoder,         "",         {kTick, kTick, kTick, kTick,    kTick,    kTick,    kTick,    kTick}},
    Expectation{Fault::encoder,         "channel_", {kNot,  kNot,  kNot,  kChannel, kChannel, kChannel, kChannel, kNot}},
    Expectation{Fault::tick_overrun,    "",         {kNot,  kNot,  kNot,  kTick,    kTick,    kTick,    kTick,    kNot}},
    // In open loop a reversed wheel does no harm.
    Expectation{Fault::runaway,         "",         {kNot,  kNot,  kNot,  kAway,    kAway,    kNot,     kAway,    kNot}},
    // In open loop there is no ramp.
    Expectation{Fault::command_timeout, "",         {kNot,  kNot,  kNot,  kRamp,    kNot,     kHost,    kNot,     kNot}},
    Expectation{Fault::link_lost,       "",         {kNot,  kNot,  kGone, kNot,     kRamp,    kNot,     kGone,    kGone}},
    Expectation{Fault::stop_timeout,    "",         {kNot,  kNot,  kNot,  kNot,     kNot,     kNot,     kRest,    kNot}},
};
// clang-format on

int stated_ms(const Cause& cause, const Situation& situation) {
  const auto found = std::ranges::find_if(kExpectations, [&](const Expectation& one) {
    return one.fault == cause.fault && one.which == cause.which;
  });
  EXPECT_NE(found, kExpectations.end()) << "no expectation for " << name(cause.fault);
  const auto column = static_cast<std::size_t>(&situation - kSituations.data());
  return found->open_ms[column];
}

class EveryFault : public testing::TestWithParam<std::tuple<std::size_t, std::size_t>> {
 protected:
  const Cause& cause_ = kCauses[std::get<0>(GetParam())];
  const Situation& situation_ = kSituations[std::get<1>(GetParam())];
};
INSTANTIATE_TEST_SUITE_P(InEveryState, EveryFault,
                         testing::Combine(testing::Range(std::size_t{0}, kCauses.size()),
                                          testing::Range(std::size_t{0}, kSituations.size())),
                         [](const auto& both) {
                           const Cause& cause = kCauses[std::get<0>(both.param)];
                           return std::string(name(cause.fault)) + "_" + cause.which +
                                  kSituations[std::get<1>(both.param)].name;
                         });

TEST_P(EveryFault, OpensTheBridgesWithinItsStatedTimeForGood) {
  const Cause& cause = cause_;
  const Situation& situation = situation_;
  DriveRig rig;
  situation.enter(rig);
  ASSERT_EQ(rig.drive().mode(), situation.mode);
  ASSERT_EQ(rig.drive().faults().mask(), 0U);
  cause.provoke(rig);
  const int stated = stated_ms(cause, situation);
  int held_ms = 0;
  for (int ms = 0; ms < 6000 && (stated == kNot || held_ms <= stated) && !rig.drive().faults().any(); ++ms) {
    rig.step();
    held_ms = cause.holds(rig) || rig.drive().faults().any() ? held_ms + 1 : 0;
  }
  if (stated == kNot) {
    EXPECT_EQ(rig.drive().faults().mask() & bit(cause.fault), 0U) << "not looked for here, but found";
    return;
  }
  if (!rig.drive().faults().any() && held_ms <= stated) {
    EXPECT_FALSE(rig.powered()) << "the condition did not last, so the ramp must have come to its end";
    return;
  }
  while (rig.powered() && held_ms <= stated) {
    rig.step();
    ++held_ms;
  }
  fmt::print("{} while {}: open after {} ms, stated {} ms\n", name(cause.fault), situation.name, held_ms,
             stated);
  EXPECT_LE(held_ms, stated);
  EXPECT_FALSE(rig.powered());
  EXPECT_EQ(rig.drive().faults().first(), cause.fault) << name(rig.drive().faults().first());
  EXPECT_FALSE(rig.drive().arm()) << "armed with a latched fault";
  for (int ms = 0; ms < 3000; ++ms) {
    rig.step();
    ASSERT_FALSE(rig.powered()) << "it moved again by itself after " << ms << " ms";
  }
  EXPECT_FALSE(rig.drive().armed());
}

TEST_P(EveryFault, IsNotArmedByClearing) {
  const Cause& cause = cause_;
  const Situation& situation = situation_;
  DriveRig rig;
  situation.enter(rig);
  cause.provoke(rig);
  rig.run_ms(4000);
  const bool stopped = rig.drive().faults().any();
  rig.repair();
  rig.run_ms(500);
  EXPECT_TRUE(rig.drive().clear_faults() || !stopped);
  rig.run_ms(500);
  EXPECT_FALSE(stopped && rig.drive().armed());
}

}  // namespace
}  // namespace astro
