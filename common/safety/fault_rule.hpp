#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/safety/fault.hpp"
#include "common/safety/state.hpp"

namespace astro {

/// What a fault does to a robot that drives.
enum class Reaction : std::uint8_t {
  off,   // bridges open in the tick in which it is found
  ramp,  // to rest by a ramp, then off: the robot is in order, its host is not
};

/// What the robot looks for by itself. Several checks may raise the same fault.
enum class Check : std::uint8_t {
  command_timeout,
  link_lost,
  driver,
  under_voltage,
  over_voltage,
  over_speed,
  stall,
  encoder_jump,     // more counts in a tick than a motor can turn
  encoder_channel,  // counts to and fro: the decoder sees one of two channels
  tick_overrun,
  runaway,
  stop_timeout,
};
inline constexpr std::size_t kChecks = 12;

/// In which states a check is made, after how long its condition is found at the latest, and what follows.
struct FaultRule {
  Check check;
  Fault fault;
  Reaction reaction;
  StateMask watched;
  std::uint16_t hold_ms;
};

namespace rule_detail {

using enum State;
inline constexpr StateMask kAlways = states(boot, disarmed, armed, driving, stopping, fault);
inline constexpr StateMask kPowered = states(driving, stopping);
inline constexpr StateMask kArmed = states(armed, driving, stopping);

}  // namespace rule_detail

/// THE table of checks, in the order of their numbers. The faults parameters, flash, emergency_stop and
/// watchdog have no row: the start, the flash and hosts report them.
inline constexpr auto kFaultRules = std::to_array<FaultRule>({
    // A hold time of 0 stands for a parameter, or for the first tick in which the condition is true.
    {Check::command_timeout, Fault::command_timeout, Reaction::ramp, states(State::driving), 0},
    {Check::link_lost, Fault::link_lost, Reaction::ramp, rule_detail::kArmed, 0},
    {Check::driver, Fault::driver, Reaction::off, rule_detail::kArmed, 0},
    {Check::under_voltage, Fault::under_voltage, Reaction::off, rule_detail::kPowered, 100},
    {Check::over_voltage, Fault::over_voltage, Reaction::off, rule_detail::kAlways, 24},
    {Check::over_speed, Fault::over_speed, Reaction::off, rule_detail::kAlways, 24},
    {Check::stall, Fault::stall, Reaction::off, rule_detail::kPowered, 0},
    {Check::encoder_jump, Fault::encoder, Reaction::off, rule_detail::kAlways, 0},
    {Check::encoder_channel, Fault::encoder, Reaction::off, rule_detail::kPowered, 48},
    {Check::tick_overrun, Fault::tick_overrun, Reaction::off, rule_detail::kPowered, 0},
    {Check::runaway, Fault::runaway, Reaction::off, rule_detail::kPowered, 48},
    {Check::stop_timeout, Fault::stop_timeout, Reaction::off, states(State::stopping), 1000},
});

constexpr const FaultRule& rule(Check check) { return kFaultRules[static_cast<std::size_t>(check)]; }

/// Each slow check is made once in so many ticks. A condition is found when as many checks in a row saw it as
/// fit into `hold_ms`: less than a period sooner, never later than `hold_ms` rounded up to whole periods.
inline constexpr std::uint32_t kWatchPeriod_ms = 8;

/// The longest ramp to rest after a fault; a robot that still moves is then left to coast.
inline constexpr std::uint32_t kRampAtMost_ms = 2500;

/// A robot that stops, or stands armed, whose host has said nothing for so long has no host any more, and its
/// bridges open. Armed it waits for command_timeout if that is longer, and for ever if that is switched off.
/// About 2.5 s; silences are counted in rounds of checks, so a time that is no whole number of them is borne
/// to the end of the round.
inline constexpr std::uint32_t kSilence_ms = 312 * kWatchPeriod_ms;

static_assert([] {
  for (std::size_t i = 0; i < kFaultRules.size(); ++i)
    if (kFaultRules[i].check != static_cast<Check>(i)) return false;
  return kFaultRules.size() == kChecks;
}());

}  // namespace astro
