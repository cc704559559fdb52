#pragma once

#include <cstdint>

#include "common/control/twist_ramp.hpp"
#include "common/kinematics/odometry.hpp"
#include "common/params/parameter_set.hpp"
#include "common/protocol/enums.hpp"
#include "firmware/app/tick/segment_path.hpp"
#include "firmware/app/tick/supervisor.hpp"
#include "firmware/app/tick/wheels.hpp"
#include "hal/interface/board.hpp"

namespace astro {

/// The robot's behaviour without a board: once a tick it takes counts, supply voltage and time and returns
/// the duty. Drive decides what moves the wheels; the Supervisor decides whether they may move.
///
/// What moves the wheels follows from the supervisor's state and, while that is `driving`, from the steering:
///
///   armed                  nothing; a path begins by itself as soon as its first segment has a profile, unless paused
///   driving, repeated      ramp_, towards a velocity that a host must repeat
///   driving, path          path_, segment by segment; paused: to rest on the path, and then armed
///   driving, open_loop     voltages_, which a host must repeat
///   stopping               ramp_, towards zero; at rest armed, or after a fault off
///   any other              nothing: the bridges are open
///
/// The supervisor may leave a state by itself, when a deadline has passed or a check has failed. Drive then follows in the
/// same tick, before it computes a set point (follow_state).
///
/// Concurrency  none of its own: tick and main loop share it through Shared.
class Drive {
 public:
  using Mode = protocol::Mode;

  struct Output {
    Permission bridge = Permission::open;
    hal::Duty duty;
  };

  /// What a parameter set means for the tick. It takes long divisions, so it is computed outside the tick and
  /// only handed over while the tick is held.
  struct Configuration {
    [[gnu::cold]] explicit Configuration(const ParameterSet& set);

    Wheels::Configuration wheels;
    MotionLimits limits;
    TwistRamp::Rates rates;
    Supervisor::Thresholds thresholds;
    ParameterSet set;  // for the gains, which need no conversion
  };

  /// What need not be done in every tick is done in some of ten, each such work in ticks of its own, so that none is long.
  static constexpr std::uint32_t kPhases = 10;
  static constexpr std::uint32_t kCorrection_ticks = 5;  // a path's correction comes in the phases 0 and 5
  static constexpr std::uint32_t kBoundaryPhase = 7;     // in which a segment begins and ends

  explicit Drive(const ParameterSet& set) { configure(set); }

  /// Replaces the parameters; the pose stays as it is. Precondition while the wheels are driven: only gains
  /// differ. The motor voltages then do not jump.
  void configure(const Configuration& configuration);
  void configure(const ParameterSet& set) { configure(Configuration(set)); }

  /// One tick.
  Output advance(const TickInput& input);

  // Requests. Those that return bool return false if they are refused; a refused request changes nothing.
  bool arm();
  void disarm();  // opens the bridges at once, empties the queue
  void stop();    // ramps to rest, empties the queue, stays armed
  bool pause();   // ramps to rest, on a path as the path goes; keeps what is left of it
  void resume() { paused_ = false; }
  void emergency_stop() { raise(Fault::emergency_stop); }
  bool drive_velocity(const BodyTwist& twist);                  // refused unless armed
  bool drive_wheels(const WheelVoltages& voltages);             // open loop; refused unless armed
  bool add_segment(const Segment& segment, std::uint16_t tag);  // refused unless armed and with room
  void set_pose(const Pose& pose) {                             // precondition: stopped_without_power()
    odometry_.set_pose(pose);
    path_.pose_was_set();
  }
  void raise(Fault fault);
  bool clear_faults() { return supervisor_.clear(); }  // refused while the wheels are driven

  /// A good frame came from the host that drives.
  void host_seen() { supervisor_.host_seen(); }

  // The ramp to a new velocity takes divisions, too. These three steps replace drive_velocity(twist); the
  // second one needs no hold of the tick.

  /// The ramp as it would begin now.
  TwistRamp ramp_from_here() const;
  /// Sets the ramp's target to `twist`, reduced to the limits.
  static void aim(TwistRamp& ramp, const BodyTwist& twist, const MotionLimits& limits);
  bool drive_velocity(const TwistRamp& planned);

  // So does the ramp to rest. These replace stop(); between them the caller sets the target of the ramp to zero.

  TwistRamp ramp_to_rest() const;
  void stop(const TwistRamp& planned);

  /// Does the longest part of drive_velocity() beforehand, so that each hold is short: ends the segments that
  /// wait in the queue, unless drive_velocity() would be refused.
  void drop_waiting();

  // The profile of the next segment takes divisions and roots, so it is computed outside the tick.

  /// As SegmentPath has them.
  bool wants_plan(Segment& segment, std::uint8_t& ticket) const { return path_.wants_plan(segment, ticket); }
  void take_plan(const Trapezoid& profile, std::uint8_t ticket) { path_.take_plan(profile, ticket); }
  /// Does both, for owners whose tick cannot interrupt them.
  void plan();

  /// Which of ten ticks the last one was.
  std::uint32_t phase() const { return phase_; }
  /// Whether a path is corrected in this tick.
  bool corrects_path() const { return phase_ % kCorrection_ticks == 0; }
  State state() const { return supervisor_.state(); }
  bool armed() const { return within(state(), states(State::armed, State::driving, State::stopping)); }
  /// The motors drive the wheels: a command, a segment or a ramp to rest is under way. The wheels of a robot
  /// without power may still roll.
  bool gives_power() const { return supervisor_.permission() == Permission::drive; }
  bool stopped_without_power() const { return !gives_power() && wheels_.stopped(); }
  /// Also true while there is no room for the event that another segment's end would need.
  bool queue_full() const { return path_.full(); }
  Mode mode() const { return mode_of(manner()); }
  /// All that the mode is made of. It costs less to keep.
  struct Manner {
    State state;
    Supervisor::Steering steering;
    bool paused;
  };
  Manner manner() const { return {state(), steering_, paused_}; }
  static Mode mode_of(const Manner& manner);
  const Pose& pose() const { return odometry_.pose(); }
  const Wheels& wheels() const { return wheels_; }
  const PathFollower& follower() const { return path_.follower(); }
  BodyTwist twist() const { return to_body(geometry_, wheels_.speeds()); }
  const FaultLatch& faults() const { return supervisor_.faults(); }
  std::uint16_t running_tag() const { return on_path() ? path_.tag() : std::uint16_t{0}; }
  std::size_t queued() const { return path_.waiting(); }
  SegmentEvents& events() { return path_.events(); }
  /// True once after the supervisor has checked a tick.
  bool take_supervised() { return supervisor_.take_checked(); }

 private:
  using Steering = Supervisor::Steering;
  struct SetPoint {
    BodyTwist twist;
    BodyTwist acceleration;
  };

  bool on_path() const { return steering_ == Steering::path && state() == State::driving; }
  void follow_state();
  BodyTwist start_of_ramp() const;
  void begin_ramp();
  void end_steering();
  bool request_stop();
  void end_segments();
  bool start_path();
  void end_segment();
  SetPoint set_point();
  SetPoint set_point_of_ramp();
  SetPoint set_point_of_path();
  bool begins_ramp() const;
  Output output(const SetPoint& set_point, const TickInput& input);

  Geometry geometry_;
  MotionLimits limits_;

  Odometry odometry_{Geometry{}};
  Wheels wheels_;
  Supervisor supervisor_;
  /// Other than none while the state is `driving`, and until a change of it has been followed.
  Steering steering_ = Steering::none;
  bool paused_ = false;  // no segment begins
  WheelVoltages voltages_;
  std::uint64_t now_us_ = 0;
  std::uint32_t phase_ = 0;
  SegmentPath path_;
  TwistRamp ramp_;
};

/// Sets a board's bridges as a tick has decided.
template <hal::Motors Motors>
void apply(const Drive::Output& output, Motors& motors) {
  switch (output.bridge) {
    case Permission::drive:
      return motors.drive(output.duty);
    case Permission::brake:
      return motors.brake();
    case Permission::open:
      return motors.coast();
  }
}

}  // namespace astro
