#pragma once

#include <cstdint>

#include "common/control/path_follower.hpp"
#include "common/safety/watch.hpp"
#include "firmware/app/tick/segment_queue.hpp"

namespace astro {

/// The segments that hosts send: those that wait, the one that is driven, and what is reported of their ends. Segments that
/// follow one another are one path, also after a pause: the next begins where the reference has arrived.
///
/// Concurrency  none of its own, like Drive, which owns it.
class SegmentPath {
 public:
  void set_gains(const ParameterSet& set) { follower_.set_gains(set); }

  // ---- segments that wait

  /// Precondition: !full().
  void add(const Segment& segment, std::uint16_t tag) { queue_.push({segment, tag}); }
  /// Also true while there is no room for the event that another segment's end would need.
  bool full() const {
    return queue_.size() >= kQueueLength || queue_.size() + events_.size() + 2 > kEventsLength;
  }
  std::size_t waiting() const { return queue_.size(); }
  /// Reports all that wait as aborted. The path ends with them.
  void drop_waiting(std::uint64_t now_us);

  // The profile of the next segment takes divisions and roots, so it is computed outside the tick. The ticket tells whether
  // the profile is still that of the next segment when it is handed in.

  /// The segment that needs a profile, and the ticket that take_plan() asks for; false if none needs one.
  bool wants_plan(Segment& segment, std::uint8_t& ticket) const;
  /// Ignores the profile if the queue has changed since the ticket was given.
  void take_plan(const Trapezoid& profile, std::uint8_t ticket);
  /// The next segment has its profile.
  bool ready() const { return planned_; }

  // ---- the segment that is driven

  /// Begins the next segment. A path that was left off goes on where its reference stands, unless the robot is somewhere
  /// else by now. Precondition: ready().
  void begin_at(const Pose& pose, std::uint64_t now_us);
  /// Goes on with the next segment of the same path. Precondition: ready().
  void begin_next(std::uint64_t now_us);
  /// Brings the reference to rest on the path, for a pause.
  void cut_short() { follower_.cut_short(); }
  /// One tick on the path, as PathFollower has it.
  PathFollower::Command advance(const Pose& pose, bool corrects) { return follower_.advance(pose, corrects); }
  /// The reference has come to the end of the segment. From then on settled() is asked in every tick.
  bool arrived() const { return follower_.arrived(); }
  /// The robot rests where the reference does, or will not get any closer.
  bool settled(bool wheels_stopped);
  /// Ends the segment that is driven: it is complete, or what a pause has left of it becomes the next one.
  void end(std::uint64_t now_us);
  /// Reports it as aborted.
  void abort(std::uint64_t now_us) { report(SegmentEvent::Kind::aborted, now_us); }

  /// The robot's pose was set anew, so the path does not go on from where it was.
  void pose_was_set() { continues_ = false; }

  std::uint16_t tag() const { return running_.tag; }
  const PathFollower& follower() const { return follower_; }
  SegmentEvents& events() { return events_; }

 private:
  void front_has_changed();
  void report(SegmentEvent::Kind kind, std::uint64_t now_us) { events_.push({now_us, running_.tag, kind}); }

  PathFollower follower_;
  QueuedSegment running_;
  std::uint32_t settling_ticks_ = 0;
  Watch settled_;
  bool continues_ = false;   // the next segment continues the path of the last one
  bool planned_ = false;     // next_ is the profile of the front of the queue
  std::uint8_t ticket_ = 0;  // changes whenever the front of the queue does
  Trapezoid next_;
  SegmentQueue queue_;
  SegmentEvents events_;
};

}  // namespace astro
