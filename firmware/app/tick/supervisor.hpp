#pragma once

#include <cstdint>
#include <utility>

#include "common/fixed/saturate.hpp"
#include "common/params/parameter_set.hpp"
#include "common/safety/fault_latch.hpp"
#include "common/safety/fault_rule.hpp"
#include "common/safety/state.hpp"
#include "common/safety/watch.hpp"
#include "firmware/app/tick/wheels.hpp"

namespace astro {

/// The single place that decides whether the motors may run. It holds the state, the latched faults and the
/// deadlines, and checks in every tick for what must stop the robot (the table in
/// common/safety/fault_rule.hpp).
///
///   driver            the bridge reports over-current or over-temperature
///   under_voltage     the supply is below `battery_low`; 0 switches the check off
///   over_voltage      the supply is above `battery_high`; 0 switches the check off
///   over_speed        a wheel is faster than `over_speed`
///   stall             a wheel has stopped under more than half of the usable voltage for `stall_time`
///   encoder           more counts in a tick than a motor can make; or counts to and fro while the motor
///                     pulls, which is how a decoder counts if one of its two channels is missing
///   runaway           a wheel turns against more than half of the usable voltage: motor or encoder is
///                     reversed
///   tick_overrun      a tick came too late, or a thousand ticks took longer or shorter than a second
///   command_timeout   no velocity or voltage for longer than the parameter of that name
///   link_lost         nothing came from the host that drives: on a path for `command_timeout`, in a ramp for
///                     kSilence_ms (from its beginning on, for whoever stops the robot is there), at rest for the longer of the two
///   stop_timeout      the wheels still turn although their set point has been zero for a second
///
/// Every ramp to rest ends: its set point reaches zero within the time that the motion limits give, and the
/// bridges open a second after that at the latest. After a fault they open within kRampAtMost_ms.
///
/// Cost  constant: the urgent checks in every tick, and one of the slower checks in turn.
class Supervisor {
 public:
  /// What moves the wheels, and so what a host has to do for them to go on: repeat its command, or just stay
  /// alive on a path.
  enum class Steering : std::uint8_t { none, repeated, path, open_loop };

  /// What a parameter set means for the checks. It takes long divisions, so it is computed outside the tick.
  struct Thresholds {
    [[gnu::cold]] explicit Thresholds(const ParameterSet& set);

    std::int32_t battery_low_mv, battery_high_mv, over_speed_umps;
    std::uint32_t stall_visits;
    std::uint32_t timeout_visits, armed_visits;  // how long the host may be silent: driving, armed
    std::uint64_t longest_ramp_us;               // from the fastest legal speed to the latest end of a ramp
  };

  void configure(const Thresholds& thresholds) { thresholds_ = thresholds; }

  State state() const { return state_; }
  Permission permission() const { return astro::permission(state_); }
  const FaultLatch& faults() const { return faults_; }

  /// False, and nothing changes, if the state does not allow it, or if it would give power while a fault is
  /// latched.
  bool request(Event event);
  /// Latches the fault and opens the bridges.
  void raise(Fault fault);
  /// Releases all faults; false while the wheels are driven.
  bool clear();

  /// A velocity or voltages came, which a host must repeat.
  void command_seen() { command_visits_ = 0; }
  /// A good frame came from the host that drives.
  void host_seen() { host_visits_ = 0; }

  /// Called in every tick of a ramp to rest whose set point has reached zero.
  void set_point_is_zero();

  void advance(const TickInput& input, bool plausible, Steering steering, const Wheels& wheels);

  /// True once after advance() came to its end.
  bool take_checked() { return std::exchange(checked_, false); }

 private:
  struct WheelWatch {
    Watch stall, lost_channel, runaway;
    std::uint32_t counts = 0, edges = 0;  // at the last visit
  };

  static constexpr std::uint64_t kNever_us = UINT64_MAX;

  /// The table lets this check be made in the present state. A check that is made in every state does not
  /// read the state.
  bool made_now(Check check) const {
    return rule(check).watched == rule_detail::kAlways || within(state_, rule(check).watched);
  }
  /// The motor gets more than half of the usable voltage.
  bool pulls(std::int32_t duty) const { return exceeds(duty, pulling_duty_); }
  /// The condition of this check is true: does what the table says.
  void react(Check check);
  void begin_ramp();
  /// Makes one of the slower checks, in turn.
  void make_slow_check(const TickInput& input, Steering steering, const Wheels& wheels);
  void check_supply(std::int32_t battery_mv);
  void check_speed(const WheelSpeeds& speeds);
  void check_stall(Watch& watch, std::int32_t duty, std::int32_t speed_umps);
  void check_runaway(Watch& watch, std::int32_t duty, std::int32_t speed_umps, Steering steering);
  void check_channels(WheelWatch& watch, std::int32_t duty, std::int32_t counts, std::uint32_t edges);
  [[gnu::noinline]] void check_ramp();
  void check_host(Steering steering);
  Check host_check(Steering steering) const;
  std::uint32_t visits_allowed() const;
  void check_boot();

  Thresholds thresholds_{ParameterSet{}};
  std::int32_t pulling_duty_ = 0;  // half of the usable voltage, see pulls()
  State state_ = State::boot;
  FaultLatch faults_;
  bool proven_ = false;
  bool checked_ = false;
  std::uint32_t turn_ = 0;
  std::uint8_t good_rounds_ = 0;
  Watch under_voltage_, over_voltage_, over_speed_;
  WheelWatch left_, right_;
  std::uint64_t now_us_ = 0;
  std::uint32_t command_visits_ = 0, host_visits_ = 0;  // calls of check_host() since then
  std::uint64_t ramp_deadline_us_ = kNever_us;          // when a ramp after a fault must end
  std::uint64_t rest_deadline_us_ = kNever_us;          // when any ramp must end
};

}  // namespace astro
