#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "common/safety/fault_rule.hpp"
#include "tests/support/drive_rig.hpp"

// Every fault that the robot looks for, provoked in every state that it can be in: the bridges are open
// within the time that the table of rules states, and nothing moves again by itself.
namespace astro {
namespace {

using protocol::Mode;
using support::DriveRig;

constexpr int kTimeout_ms = 200;  // the default command_timeout
constexpr int kStall_ms = 300;    // the default stall_time

struct Cause {
  Fault fault;
  std::function<void(DriveRig&)> provoke;
  /// From now on the condition of the fault holds.
  std::function<bool(DriveRig&)> holds;
  const char* which = "";    // of several causes of one fault
  bool needs_power = false;  // it shows only while the motor pulls
};

const std::vector<Cause> kCauses{
    {Fault::driver, [](DriveRig& rig) { rig.board().motors().set_fault(true); },
     [](DriveRig&) { return true; }},
    {Fault::under_voltage, [](DriveRig& rig) { rig.board().battery().set_open_circuit_V(9); },
     [](DriveRig& rig) { return rig.board().battery().millivolts() < 10'500; }},
    {Fault::over_voltage, [](DriveRig& rig) { rig.board().battery().set_open_circuit_V(16); },
     [](DriveRig& rig) { return rig.board().battery().millivolts() > 14'000; }},
    {Fault::over_speed,
     [](DriveRig& rig) { rig.board().set_load(sim::Side::left, {.torque_Nm = 20}); },  // down a cliff
     [](DriveRig& rig) { return rig.drive().wheels().speeds().left_umps > 1'200'000; }},
    {Fault::stall, [](DriveRig& rig) { rig.board().set_load(sim::Side::right, {.drag_Nm = 100}); },
     [](DriveRig& rig) {
       return std::abs(rig.drive().wheels().forward_duty().right) > 16'383 &&
              std::abs(rig.drive().wheels().speeds().right_umps) <= 2'000;
     }},
    {Fault::encoder,
     [](DriveRig& rig) {
       const hal::EncoderCounts now = rig.board().encoders().read();
       rig.board().encoders().preset({now.left, now.right - 50'000});
     },
     [](DriveRig&) { return true; }},
    {Fault::encoder, [](DriveRig& rig) { rig.board().encoders().lose_channel(sim::Side::left); },
     [](DriveRig& rig) {  // the wheel really turns, and the motor pulls
       return std::abs(rig.drive().wheels().forward_duty().left) > 16'383 && std::abs(rig.left_mps()) > 0.05;
     },
     "channel_", true},
    {Fault::tick_overrun, [](DriveRig& rig) { rig.late_ticks = 1; }, [](DriveRig&) { return true; }},
    {Fault::runaway, [](DriveRig& rig) { rig.reverse_left_encoder(); },
     [](DriveRig& rig) {
       const std::int32_t duty = rig.drive().wheels().forward_duty().left;
       const std::int32_t speed_umps = rig.drive().wheels().speeds().left_umps;
       return std::abs(duty) > 16'383 && std::abs(speed_umps) > 50'000 && (duty < 0) != (speed_umps < 0);
     }},
    {Fault::command_timeout, [](DriveRig& rig) { rig.release(); }, [](DriveRig&) { return true; }},
    {Fault::link_lost, [](DriveRig& rig) { rig.silent = true; }, [](DriveRig&) { return true; }},
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

/// The state that a situation is, for the table of rules.
bool watched(const Cause& cause, Mode mode) {
  const Fault fault = cause.fault;
  if (cause.needs_power)
    return mode == Mode::velocity || mode == Mode::segment || mode == Mode::stopping || mode == Mode::wheels;
  switch (mode) {
    case Mode::boot:
      return within(State::boot, rule(fault).watched);
    case Mode::disarmed:
      return within(State::disarmed, rule(fault).watched);
    case Mode::stopping:
      return within(State::stopping, rule(fault).watched);
    case Mode::velocity:
      return within(State::driving, rule(fault).watched) && fault != Fault::link_lost;
    case Mode::segment:
      return within(State::driving, rule(fault).watched) && fault != Fault::command_timeout;
    case Mode::wheels:  // open loop: nothing can run away, and no path has a link to lose
      return within(State::driving, rule(fault).watched) && fault != Fault::link_lost &&
             fault != Fault::runaway;
    default:
      return within(State::armed, rule(fault).watched);
  }
}

int stated_ms(const Cause& cause, Mode mode) {
  const Fault fault = cause.fault;
  const int looked_at = static_cast<int>(kWatchPeriod_ms) + 1;
  // A jump; or counts to and fro, told by the way between two visits, of which each wheel has every second.
  if (fault == Fault::encoder && !cause.needs_power) return 1;
  if (fault == Fault::encoder) return rule(fault).hold_ms + 2 * 2 * looked_at;
  if (fault == Fault::stall) return kStall_ms + looked_at + static_cast<int>(kWatchPeriod_ms);
  if (rule(fault).reaction == Reaction::off) return rule(fault).hold_ms + looked_at;
  const int ramp = mode == Mode::wheels ? 0 : static_cast<int>(kRampAtMost_ms);
  return kTimeout_ms + looked_at + ramp;
}

class EveryFault : public testing::TestWithParam<std::tuple<Cause, Situation>> {};
INSTANTIATE_TEST_SUITE_P(InEveryState, EveryFault,
                         testing::Combine(testing::ValuesIn(kCauses), testing::ValuesIn(kSituations)),
                         [](const auto& both) {
                           const Cause& cause = std::get<0>(both.param);
                           return std::string(name(cause.fault)) + "_" + cause.which +
                                  std::get<1>(both.param).name;
                         });

TEST_P(EveryFault, OpensTheBridgesWithinItsStatedTimeForGood) {
  const auto& [cause, situation] = GetParam();
  DriveRig rig;
  situation.enter(rig);
  ASSERT_EQ(rig.drive().mode(), situation.mode);
  ASSERT_EQ(rig.drive().faults().mask(), 0U);
  cause.provoke(rig);
  const int stated = stated_ms(cause, situation.mode);
  int held_ms = 0;
  for (int ms = 0; ms < 6000 && held_ms <= stated && !rig.drive().faults().any(); ++ms) {
    rig.step();
    held_ms = cause.holds(rig) || rig.drive().faults().any() ? held_ms + 1 : 0;
  }
  if (!watched(cause, situation.mode)) {
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
  const auto& [cause, situation] = GetParam();
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
