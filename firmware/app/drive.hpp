#pragma once

#include <cstdint>

#include "common/control/path_follower.hpp"
#include "common/control/twist_ramp.hpp"
#include "common/kinematics/odometry.hpp"
#include "common/params/parameter_set.hpp"
#include "common/protocol/enums.hpp"
#include "common/safety/watch.hpp"
#include "firmware/app/segment_queue.hpp"
#include "firmware/app/supervisor.hpp"
#include "firmware/app/wheels.hpp"
#include "hal/interface/board.hpp"

namespace astro {

/// The robot's behaviour, without a board: counts, voltage and time in, duty out, once a tick. What moves the
/// wheels is decided here; whether they may move, by the Supervisor.
///
/// Concurrency  one owner; on the MCU the main loop calls it only while it holds the tick
/// (hal::Board::hold_tick).
class Drive {
 public:
  using Mode = protocol::Mode;

  struct Output {
    Permission bridge = Permission::open;
    hal::Duty duty;
  };

  /// What a parameter set means for the tick. Takes long divisions: made outside the tick, taken in inside.
  struct Configuration {
    [[gnu::cold]] explicit Configuration(const ParameterSet& set);

    Wheels::Configuration wheels;
    MotionLimits limits;
    TwistRamp::Rates rates;
    Supervisor::Thresholds thresholds;
    ParameterSet set;  // the gains, which need no computing
  };

  explicit Drive(const ParameterSet& set) { configure(set); }

  /// Replaces the parameters; the pose stays where it is. While the wheels are driven only a set of the same
  /// geometry, polarities and limits: then without a bump.
  void configure(const Configuration& configuration);
  void configure(const ParameterSet& set) { configure(Configuration(set)); }

  /// One tick.
  Output advance(const TickInput& input);

  // Requests. Each says whether it was taken; a refused one has changed nothing.
  bool arm() { return supervisor_.request(Event::arm); }
  void disarm();  // coasts at once, empties the queue
  void stop();    // ramps to rest, empties the queue, stays armed
  bool pause();   // comes to rest on the path, the queue waits; false while something else moves the wheels
  void resume() { paused_ = false; }
  void emergency_stop() { raise(Fault::emergency_stop); }
  bool drive_velocity(const BodyTwist& twist);                  // false unless armed
  bool drive_wheels(const WheelVoltages& voltages);             // open loop; false unless armed
  bool add_segment(const Segment& segment, std::uint16_t tag);  // false unless armed with room
  void set_pose(const Pose& pose) {                             // only at rest
    odometry_.set_pose(pose);
    path_open_ = false;
  }
  void raise(Fault fault);
  bool clear_faults() { return supervisor_.clear(); }  // false while the wheels are driven

  /// A good frame from the host that drives.
  void host_seen() { supervisor_.host_seen(); }

  // The ramp to a new velocity takes divisions, too: three steps instead of drive_velocity(), of which the
  // second needs no hold of the tick.

  /// As the ramp would begin now.
  TwistRamp ramp_from_here() const;
  /// Gives it its target, within the limits.
  void aim(TwistRamp& ramp, const BodyTwist& twist) const;
  bool drive_velocity(const TwistRamp& planned);
  /// Of what drive_velocity() does, the long part beforehand: ends the segments that wait, if it would be
  /// taken.
  void drop_waiting();

  // The profile of the next segment takes divisions and roots: it is made outside the tick.

  /// The segment whose profile is wanted, and the ticket to hand it in with; false if none is.
  bool wants_plan(Segment& segment, std::uint8_t& ticket) const;
  /// Ignored if the queue has changed since.
  void take_plan(const Trapezoid& profile, std::uint8_t ticket);
  /// Both, for owners whose tick cannot interrupt them.
  void plan();

  State state() const { return supervisor_.state(); }
  bool armed() const { return within(state(), states(State::armed, State::driving, State::stopping)); }
  /// Commands or segments move the wheels, or a ramp does.
  bool driving() const { return supervisor_.permission() == Permission::drive; }
  bool at_rest() const { return !driving(); }
  /// At rest, and the wheels do not roll on either.
  bool stands() const { return at_rest() && standing(); }
  /// Also while there is no room to tell how another segment ended.
  bool queue_full() const {
    return queue_.size() >= kQueueLength || queue_.size() + events_.size() + 2 > kEventsLength;
  }
  Mode mode() const;
  const Pose& pose() const { return odometry_.pose(); }
  const Wheels& wheels() const { return wheels_; }
  const PathFollower& follower() const { return follower_; }
  const MotionLimits& limits() const { return limits_; }
  BodyTwist twist() const { return to_body(geometry_, wheels_.speeds()); }
  const FaultLatch& faults() const { return supervisor_.faults(); }
  std::uint16_t running_tag() const { return on_path() ? running_.tag : std::uint16_t{0}; }
  std::size_t queued() const { return queue_.size(); }
  SegmentEvents& events() { return events_; }
  /// True once after the supervisor has looked at a tick.
  bool take_supervised() { return supervisor_.take_watched(); }

 private:
  using Steering = Supervisor::Steering;
  struct Wish {
    BodyTwist twist;
    BodyTwist acceleration;
  };

  bool on_path() const { return steering_ == Steering::path && state() == State::driving; }
  void follow_state();
  void state_is_followed() { seen_ = state(); }
  void begin_ramp();
  void end_segments();
  void end_waiting();
  bool standing() const;
  void start_path();
  void start_segment();
  void end_segment();
  void put_back(Segment rest);
  void report(SegmentEvent::Kind kind, std::uint16_t tag);
  Wish wish();
  Wish ramped();
  bool begins_ramp() const;
  Wish follow();
  Output output(const Wish& wish, const TickInput& input);

  Geometry geometry_;
  MotionLimits limits_;

  Odometry odometry_{Geometry{}};
  Wheels wheels_;
  PathFollower follower_;
  TwistRamp ramp_;
  Supervisor supervisor_;
  State seen_ = State::boot;  // the state that everything here follows
  Steering steering_ = Steering::none;
  WheelVoltages voltages_;

  SegmentQueue queue_;
  SegmentEvents events_;
  QueuedSegment running_;
  Trapezoid next_;  // of the front of the queue
  bool planned_ = false;
  bool paused_ = false;
  bool path_open_ = false;   // the next segment belongs to the path of the last one
  std::uint8_t ticket_ = 0;  // changes with the front of the queue
  std::uint32_t settling_ticks_ = 0;
  Watch settled_;
  std::uint64_t now_us_ = 0;
};

/// What a tick has decided, to a board's bridges.
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
