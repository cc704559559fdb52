#pragma once

#include <array>
#include <cstdint>

#include "common/safety/fault.hpp"
#include "common/safety/state.hpp"

namespace astro {

/// What a fault does to a robot that drives.
enum class Reaction : std::uint8_t {
  off,   // bridges open in the tick in which it is found
  ramp,  // to rest by a ramp, then off: the robot is in order, its host is not
};

/// Where a fault is looked for, for how long its condition must hold, and what follows.
struct FaultRule {
  Fault fault;
  Reaction reaction;
  StateMask watched;
  std::uint16_t hold_ms;
};

namespace rule_detail {

using enum State;
inline constexpr StateMask kAlways = states(boot, disarmed, armed, driving, stopping, fault);
inline constexpr StateMask kPowered = states(driving, stopping);

}  // namespace rule_detail

/// THE table of faults, in the order of their numbers. Faults with an empty set of states are told, not
/// looked for: by the link, the flash, or the start.
inline constexpr auto kFaultRules = std::to_array<FaultRule>({
    {Fault::none, Reaction::off, 0, 0},
    {Fault::command_timeout, Reaction::ramp, states(State::driving), 0},
    {Fault::link_lost, Reaction::ramp, states(State::driving), 0},
    {Fault::driver, Reaction::off, states(State::armed, State::driving, State::stopping), 0},
    {Fault::under_voltage, Reaction::off, rule_detail::kPowered, 100},
    {Fault::over_voltage, Reaction::off, rule_detail::kAlways, 24},
    {Fault::over_speed, Reaction::off, rule_detail::kAlways, 24},
    {Fault::stall, Reaction::off, rule_detail::kPowered, 0},    // the parameter stall_time
    {Fault::encoder, Reaction::off, rule_detail::kAlways, 48},  // a jump at once; to and fro while powered
    {Fault::tick_overrun, Reaction::off, rule_detail::kPowered, 0},
    {Fault::parameters, Reaction::off, 0, 0},
    {Fault::flash, Reaction::off, 0, 0},
    {Fault::emergency_stop, Reaction::off, 0, 0},
    {Fault::runaway, Reaction::off, rule_detail::kPowered, 48},
    {Fault::watchdog, Reaction::off, 0, 0},
});

constexpr const FaultRule& rule(Fault fault) { return kFaultRules[static_cast<std::size_t>(fault)]; }

/// Each watch is looked at once in so many ticks: a condition is found up to that much later than it holds.
inline constexpr std::uint32_t kWatchPeriod_ms = 8;

/// The longest ramp to rest after a fault; a robot that still moves is then left to coast.
inline constexpr std::uint32_t kRampAtMost_ms = 2500;

static_assert([] {
  for (std::size_t i = 0; i < kFaultRules.size(); ++i)
    if (kFaultRules[i].fault != static_cast<Fault>(i)) return false;
  return kFaultRules.size() == kFaultNames.size();
}());

}  // namespace astro
