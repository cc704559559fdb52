#include "common/safety/fault_rule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

// The tables of safety once more, written by hand: whoever changes or removes a row must change it here, too.
namespace astro {
namespace {

using enum State;

struct Row {
  Check check;
  Fault fault;
  Reaction reaction;
  std::vector<State> watched;
  int hold_ms;
};

const std::vector<State> kEverywhere{boot, disarmed, armed, driving, stopping, State::fault};
const std::vector<State> kWithPower{driving, stopping};
const std::vector<State> kArmedOrMoving{armed, driving, stopping};

const std::vector<Row> kRows{
    {Check::command_timeout, Fault::command_timeout, Reaction::ramp, {driving}, 0},
    {Check::open_loop_timeout, Fault::command_timeout, Reaction::off, {driving}, 0},
    {Check::path_host_lost, Fault::link_lost, Reaction::ramp, {driving}, 0},
    {Check::stopping_host_lost, Fault::link_lost, Reaction::off, {stopping}, 2496},
    {Check::armed_host_lost, Fault::link_lost, Reaction::off, {armed}, 2496},
    {Check::driver, Fault::driver, Reaction::off, kArmedOrMoving, 0},
    {Check::under_voltage, Fault::under_voltage, Reaction::off, kWithPower, 100},
    {Check::over_voltage, Fault::over_voltage, Reaction::off, kEverywhere, 24},
    {Check::over_speed, Fault::over_speed, Reaction::off, kEverywhere, 24},
    {Check::stall, Fault::stall, Reaction::off, kWithPower, 0},
    {Check::encoder_jump, Fault::encoder, Reaction::off, kEverywhere, 0},
    {Check::encoder_channel, Fault::encoder, Reaction::off, kWithPower, 48},
    {Check::tick_overrun, Fault::tick_overrun, Reaction::off, kWithPower, 0},
    {Check::runaway, Fault::runaway, Reaction::off, kWithPower, 48},
    {Check::stop_timeout, Fault::stop_timeout, Reaction::off, {stopping}, 1000},
};

TEST(FaultRule, EveryRowIsAsWrittenHere) {
  ASSERT_EQ(kFaultRules.size(), kRows.size());
  for (const Row& row : kRows) {
    const FaultRule& rule = astro::rule(row.check);
    SCOPED_TRACE("check " + std::to_string(static_cast<int>(row.check)));
    EXPECT_EQ(rule.check, row.check);
    EXPECT_EQ(rule.fault, row.fault);
    EXPECT_EQ(rule.reaction, row.reaction);
    EXPECT_EQ(rule.hold_ms, row.hold_ms);
    for (const State state : kEverywhere)
      EXPECT_EQ(within(state, rule.watched), std::ranges::find(row.watched, state) != row.watched.end())
          << "state " << static_cast<int>(state);
  }
}

TEST(FaultRule, TheTimesOfAllRowsAreAsWrittenHere) {
  EXPECT_EQ(kWatchPeriod_ms, 8U);
  EXPECT_EQ(kRampAtMost_ms, 2500U);
  EXPECT_EQ(kSilence_ms, 2496U);
}

TEST(FaultRule, ASilentHostHasOpenBridgesWithinThreeSeconds) {
  constexpr std::uint32_t kTimeout_ms = 200;  // the default command_timeout
  EXPECT_LT(kTimeout_ms + kRampAtMost_ms + 2 * kWatchPeriod_ms, 3000U);
  EXPECT_LT(kSilence_ms + kWatchPeriod_ms, 3000U);
}

TEST(StateMask, HoldsTheStatesThatItWasMadeOfAndNoOther) {
  EXPECT_EQ(states(), 0);
  EXPECT_EQ(states(boot), 1);
  EXPECT_EQ(states(disarmed, State::fault), 0b10'0010);
  EXPECT_TRUE(within(boot, 0b00'0001));
  EXPECT_TRUE(within(disarmed, 0b00'0010));
  EXPECT_TRUE(within(armed, 0b00'0100));
  EXPECT_TRUE(within(driving, 0b00'1000));
  EXPECT_TRUE(within(stopping, 0b01'0000));
  EXPECT_TRUE(within(State::fault, 0b10'0000));
  EXPECT_FALSE(within(boot, 0b11'1110));
  EXPECT_FALSE(within(disarmed, 0b11'1101));
  EXPECT_FALSE(within(armed, 0b11'1011));
  EXPECT_FALSE(within(driving, 0b11'0111));
  EXPECT_FALSE(within(stopping, 0b10'1111));
  EXPECT_FALSE(within(State::fault, 0b01'1111));
}

// For each state, where each event leads; `no` is a refusal, which changes nothing.
TEST(StateTable, EveryTransitionIsAsWrittenHere) {
  constexpr auto no = static_cast<State>(0xFF);
  struct Transitions {
    State from;
    State proven, arm, disarm, drive, stop, rest, fault, clear;
  };
  constexpr auto fault = State::fault;
  const std::vector<Transitions> expected{
      {boot, disarmed, no, boot, no, boot, boot, fault, boot},
      {disarmed, disarmed, armed, disarmed, no, disarmed, disarmed, fault, disarmed},
      {armed, armed, armed, disarmed, driving, armed, armed, fault, armed},
      {driving, driving, driving, disarmed, driving, stopping, armed, fault, no},
      {stopping, stopping, stopping, disarmed, driving, stopping, armed, fault, no},
      {fault, fault, no, fault, no, fault, fault, fault, disarmed},
  };
  for (const Transitions& row : expected) {
    const auto check = [&](Event event, State to) {
      State state = row.from;
      EXPECT_EQ(advance(state, event), to != no);
      EXPECT_EQ(state, to != no ? to : row.from)
          << "from " << static_cast<int>(row.from) << " by event " << static_cast<int>(event);
    };
    check(Event::proven, row.proven);
    check(Event::arm, row.arm);
    check(Event::disarm, row.disarm);
    check(Event::drive, row.drive);
    check(Event::stop, row.stop);
    check(Event::rest, row.rest);
    check(Event::fault, row.fault);
    check(Event::clear, row.clear);
  }
}

TEST(StateTable, EveryPermissionIsAsWrittenHere) {
  EXPECT_EQ(permission(boot), Permission::open);
  EXPECT_EQ(permission(disarmed), Permission::open);
  EXPECT_EQ(permission(armed), Permission::brake);
  EXPECT_EQ(permission(driving), Permission::drive);
  EXPECT_EQ(permission(stopping), Permission::drive);
  EXPECT_EQ(permission(State::fault), Permission::open);
}

}  // namespace
}  // namespace astro
