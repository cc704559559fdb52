#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/safety/fault.hpp"
#include "common/safety/state.hpp"

namespace astro {

/// What a fault does to a robot that drives.
enum class Reaction : std::uint8_t {
  off,   // the bridges open in the tick that finds the fault
  ramp,  // the robot ramps to rest, then the bridges open: the robot is in order, its host is not
};

/// What the robot checks by itself. Several checks may raise the same fault.
enum class Check : std::uint8_t {
  command_timeout,     // no velocity from the host
  open_loop_timeout,   // no voltages from the host: without a control loop there is no ramp
  path_host_lost,      // nothing from the host that drives, on a path
  stopping_host_lost,  // the same during a ramp to rest
  armed_host_lost,     // the same at rest
  driver,
  under_voltage,
  over_voltage,
  over_speed,
  stall,
  encoder_jump,     // more counts in a tick than a motor can turn
  encoder_channel,  // counts to and fro: one of the encoder's two channels is missing
  tick_overrun,
  runaway,
  stop_timeout,
};
inline constexpr std::size_t kChecks = 15;

/// One check: in which states it is made, after how long its condition is found at the latest, and what
/// follows.
struct FaultRule {
  Check check;
  Fault fault;
  Reaction reaction;
  StateMask watched;
  std::uint16_t hold_ms;
};

/// Each slow check is made once in so many ticks. A condition is found when as many checks in a row saw it as
/// fit into `hold_ms`: less than a period sooner, never later than `hold_ms` rounded up to whole periods.
inline constexpr std::uint32_t kWatchPeriod_ms = 8;

/// A robot that stops, or stands armed, has no host any more if the host has said nothing for so long. About
/// 2.5 s, in whole periods of checks.
inline constexpr std::uint16_t kSilence_ms = 312 * kWatchPeriod_ms;

namespace rule_detail {

using enum State;
inline constexpr StateMask kAlways = states(boot, disarmed, armed, driving, stopping, fault);
inline constexpr StateMask kPowered = states(driving, stopping);
inline constexpr StateMask kArmed = states(armed, driving, stopping);

}  // namespace rule_detail

/// THE table of checks, in the order of their numbers: everything that the supervisor raises. The faults
/// parameters, flash, emergency_stop, watchdog and gyro_slip have no row: the start, the flash, hosts and the gyro report them.
inline constexpr auto kFaultRules = std::to_array<FaultRule>({
    // A hold time of 0 stands for a parameter, or for the first tick in which the condition is true.
    {Check::command_timeout, Fault::command_timeout, Reaction::ramp, states(State::driving), 0},
    {Check::open_loop_timeout, Fault::command_timeout, Reaction::off, states(State::driving), 0},
    {Check::path_host_lost, Fault::link_lost, Reaction::ramp, states(State::driving), 0},
    {Check::stopping_host_lost, Fault::link_lost, Reaction::off, states(State::stopping), kSilence_ms},
    // Or command_timeout if that is longer; never if it is 0.
    {Check::armed_host_lost, Fault::link_lost, Reaction::off, states(State::armed), kSilence_ms},
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

/// The longest ramp to rest after a fault; then the bridges open even if the robot still moves.
inline constexpr std::uint32_t kRampAtMost_ms = 2500;

static_assert([] {
  for (std::size_t i = 0; i < kFaultRules.size(); ++i) {
    if (kFaultRules[i].check != static_cast<Check>(i)) return false;
    // A ramp to rest begins where something drives.
    if (kFaultRules[i].reaction == Reaction::ramp && kFaultRules[i].watched != states(State::driving))
      return false;
  }
  return kFaultRules.size() == kChecks;
}());

}  // namespace astro
