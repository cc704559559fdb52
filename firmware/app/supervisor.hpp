#pragma once

#include <cstdint>
#include <utility>

#include "common/fixed/saturate.hpp"
#include "common/params/parameter_set.hpp"
#include "common/safety/fault_latch.hpp"
#include "common/safety/fault_rule.hpp"
#include "common/safety/state.hpp"
#include "common/safety/watch.hpp"
#include "firmware/app/wheels.hpp"

namespace astro {

/// The single place that decides whether the motors may run: it holds the state, the latch and the deadlines,
/// and looks in every tick for what must stop the robot (the table in common/safety/fault_rule.hpp).
///
/// - `driver`: the bridge reports over-current or over-temperature.
/// - `under_voltage`, `over_voltage`: supply below `battery_low`, above `battery_high`; 0 switches it off.
/// - `over_speed`: a wheel faster than `over_speed`.
/// - `stall`: more than half of the usable voltage on a wheel that does not move, for `stall_time`.
/// - `encoder`: more counts in a tick than a motor can turn; or counts to and fro while the motor pulls,
///   which is what a decoder makes of a single channel.
/// - `runaway`: a wheel turns against more than half of the usable voltage: motor or encoder is reversed.
/// - `tick_overrun`: a tick came too late, or a thousand of them took longer or shorter than a second.
/// - `command_timeout`: no velocity or voltage for longer than the parameter of that name.
/// - `link_lost`: nothing from the host that drives: on a path for `command_timeout`, in a ramp for
///   kSilence_ms, at rest for the longer of the two.
/// - `stop_timeout`: the wheels still turn although their set point has been zero for a second.
///
/// Every ramp to rest ends: its set point reaches zero within the time that the motion limits give, and the
/// bridges open at the latest a second after that. After a fault they open within kRampAtMost_ms.
///
/// Cost: constant: what must be seen at once in every tick, and one of the slower checks in turn.
class Supervisor {
 public:
  /// Who moves the wheels, and so what must go on for them to move.
  enum class Steering : std::uint8_t { none, repeated, path, open_loop };

  /// What a parameter set means for the checks. Takes long divisions: made outside the tick, taken in inside.
  struct Thresholds {
    [[gnu::cold]] explicit Thresholds(const ParameterSet& set);

    std::int32_t battery_low_mv, battery_high_mv, over_speed_umps;
    std::uint32_t stall_visits;
    std::uint32_t timeout_visits, armed_visits;  // silences of the host that are borne
    std::uint64_t longest_ramp_us;  // of the set point, from the fastest legal speed, and what follows
  };

  void configure(const Thresholds& thresholds) { thresholds_ = thresholds; }

  State state() const { return state_; }
  Permission permission() const { return astro::permission(state_); }
  const FaultLatch& faults() const { return faults_; }

  /// False, and no change, if the state does not allow it or a fault is latched and it would give power.
  bool request(Event event);
  /// Latches it, and opens the bridges.
  void raise(Fault fault);
  /// Releases all faults; false while the wheels are driven.
  bool clear();

  /// A command that must be repeated was; a good frame came from the host that drives.
  void steered() { steered_visits_ = 0; }
  void host_seen() { host_visits_ = 0; }

  /// In every tick of a ramp to rest whose set point has reached zero.
  void set_point_at_rest();

  void advance(const TickInput& input, bool plausible, Steering steering, const Wheels& wheels);

  /// True once after advance() came to its end.
  bool take_watched() { return std::exchange(watched_, false); }

 private:
  struct WheelWatch {
    Watch stall, lost_channel, runaway;
    std::uint32_t counts = 0, edges = 0;  // at the last visit
  };

  static constexpr std::uint64_t kNever_us = UINT64_MAX;

  /// For a check that is made always the state is not even looked at.
  bool watched_in(Check check) const {
    return rule(check).watched == rule_detail::kAlways || within(state_, rule(check).watched);
  }
  bool pulls(std::int32_t duty) const { return exceeds(duty, pulling_duty_); }
  void found(Check check);
  void begin_ramp();
  /// One of the slower watches, in turn.
  void look(const TickInput& input, Steering steering, const Wheels& wheels);
  void look_at_supply(std::int32_t battery_mv);
  void look_at_speed(const WheelSpeeds& speeds);
  void look_for_stall(Watch& watch, std::int32_t duty, std::int32_t speed_umps);
  void look_for_runaway(Watch& watch, std::int32_t duty, std::int32_t speed_umps, Steering steering);
  void look_for_lost_channel(WheelWatch& watch, std::int32_t duty, std::int32_t counts, std::uint32_t edges);
  [[gnu::noinline]] void look_at_ramp();
  void look_for_host(Steering steering);
  std::uint32_t visits_allowed() const;
  void look_at_boot();

  Thresholds thresholds_{ParameterSet{}};
  std::int32_t pulling_duty_ = 0;  // a motor that gets more of it pulls
  State state_ = State::boot;
  FaultLatch faults_;
  bool proven_ = false;
  bool watched_ = false;
  std::uint32_t turn_ = 0;
  std::uint8_t good_rounds_ = 0;
  Watch under_voltage_, over_voltage_, over_speed_;
  WheelWatch left_, right_;
  std::uint64_t now_us_ = 0;
  std::uint32_t steered_visits_ = 0, host_visits_ = 0;  // of look_for_host() since then
  std::uint64_t ramp_deadline_us_ = kNever_us;          // of a ramp after a fault
  std::uint64_t rest_deadline_us_ = kNever_us;          // of any ramp
};

}  // namespace astro
