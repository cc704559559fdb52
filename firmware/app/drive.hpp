#pragma once

#include <array>
#include <cstdint>

#include "common/control/path_follower.hpp"
#include "common/control/twist_ramp.hpp"
#include "common/kinematics/odometry.hpp"
#include "common/params/parameter_set.hpp"
#include "common/protocol/enums.hpp"
#include "common/safety/fault_latch.hpp"
#include "common/safety/watch.hpp"
#include "firmware/app/segment_queue.hpp"
#include "firmware/app/supervisor.hpp"
#include "firmware/app/wheels.hpp"

namespace astro {

/// The robot's behaviour, without a board: counts, voltage and time in, duty out, once a tick. The single
/// place that decides whether the motors may run.
///
/// Concurrency  one owner; on the MCU the main loop calls it only while it holds the tick
/// (hal::Board::hold_tick).
class Drive {
 public:
  using Mode = protocol::Mode;

  struct Output {
    enum class Bridge : std::uint8_t { coast, brake, drive };
    Bridge bridge = Bridge::coast;
    hal::Duty duty;
  };

  explicit Drive(const ParameterSet& set) { configure(set); }

  /// Replaces the parameters; the pose stays where it is. Only at rest.
  void configure(const ParameterSet& set);

  /// One tick.
  Output advance(const TickInput& input);

  // Requests. Each says whether it was taken; a refused one has changed nothing.
  bool arm();     // false while a fault is latched
  void disarm();  // coasts at once, empties the queue
  void stop();    // ramps to rest, empties the queue, stays armed
  void emergency_stop() { raise(Fault::emergency_stop); }
  bool drive_velocity(const BodyTwist& twist);  // false unless armed
  /// Open loop, for identification. False unless armed.
  bool drive_wheels(const WheelVoltages& voltages);
  bool add_segment(const Trapezoid& profile, std::uint16_t tag);  // false unless armed with room
  void set_pose(const Pose& pose) { odometry_.set_pose(pose); }   // only at rest
  void raise(Fault fault);
  void clear_faults();

  /// A good frame from a host: it is alive.
  void host_seen() { host_deadline_us_ = deadline_us(); }

  bool armed() const { return mode_ != Mode::disarmed && mode_ != Mode::fault; }
  bool at_rest() const { return !driving(); }
  /// Commands or segments move the wheels, or a ramp does.
  bool driving() const {
    return mode_ == Mode::velocity || mode_ == Mode::segment || mode_ == Mode::stopping ||
           mode_ == Mode::wheels;
  }
  bool queue_full() const { return queue_.full(); }
  Mode mode() const { return mode_; }
  const Pose& pose() const { return odometry_.pose(); }
  const Wheels& wheels() const { return wheels_; }
  BodyTwist twist() const { return to_body(geometry_, wheels_.speeds()); }
  const FaultLatch& faults() const { return faults_; }
  std::uint16_t running_tag() const { return mode_ == Mode::segment ? running_.tag : std::uint16_t{0}; }
  std::size_t queued() const { return queue_.size(); }
  SegmentEvents& events() { return events_; }
  /// True once after the supervisor has looked at a tick.
  bool take_supervised() { return supervisor_.take_watched(); }

 private:
  struct Wish {
    BodyTwist twist;
    BodyTwist acceleration;
  };

  void watch_over(const TickInput& input, std::uint32_t found);
  void enter_fault();
  void end_segments(protocol::SegmentOutcome running, protocol::SegmentOutcome queued);
  bool standing() const;
  std::uint64_t deadline_us() const {
    return command_timeout_us_ != 0 ? now_us_ + command_timeout_us_ : ~std::uint64_t{0};
  }
  Wish wish();
  Wish ramped();
  Wish follow();
  void next_segment();
  Output output(const Wish& wish, const TickInput& input);

  Geometry geometry_;
  MotionLimits limits_;
  std::uint64_t command_timeout_us_ = 0;

  Odometry odometry_{Geometry{}};
  Wheels wheels_;
  PathFollower follower_;
  Supervisor supervisor_;
  FaultLatch faults_;
  SegmentQueue queue_;
  SegmentEvents events_;

  Mode mode_ = Mode::disarmed;
  bool fault_after_stop_ = false;
  QueuedSegment running_;
  std::uint32_t settling_ticks_ = 0;
  Watch settled_;
  WheelVoltages voltages_;
  TwistRamp ramp_;
  std::uint64_t now_us_ = 0;
  std::uint64_t host_deadline_us_ = 0;  // nobody steers after it
  std::uint64_t velocity_deadline_us_ = 0;
};

}  // namespace astro
