#include "firmware/app/tick/segment_path.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr std::uint32_t kSettled_ticks = 50;        // stopped and close to the path's end for so long
constexpr std::uint32_t kSettleAtMost_ticks = 700;  // a robot held by friction will not get any closer

// Somebody has carried the robot away from the point where its path continues, or turned it.
bool strayed(const Pose& reference, const Pose& actual) {
  constexpr std::int64_t kFar = (std::int64_t{1} << Pose::kPositionBits) / 20;  // 50 mm
  const std::int64_t x = reference.x - actual.x, y = reference.y - actual.y;
  constexpr std::int32_t kFar_32 = 0x0400'0000;  // 1/64 turn
  const auto turn_32 = static_cast<std::int32_t>((reference.theta - actual.theta) >> 32);
  return x > kFar || x < -kFar || y > kFar || y < -kFar || exceeds(turn_32, kFar_32);
}

}  // namespace

void SegmentPath::front_has_changed() {
  planned_ = false;
  ++ticket_;
}

void SegmentPath::drop_waiting(std::uint64_t now_us) {
  events_.push_all(queue_, [now_us](const QueuedSegment& one) {
    return SegmentEvent{now_us, one.tag, SegmentEvent::Kind::aborted};
  });
  continues_ = false;
  front_has_changed();
}

bool SegmentPath::wants_plan(Segment& segment, std::uint8_t& ticket) const {
  if (planned_ || queue_.empty()) return false;
  segment = queue_.front().segment;
  ticket = ticket_;
  return true;
}

void SegmentPath::take_plan(const Trapezoid& profile, std::uint8_t ticket) {
  if (ticket != ticket_ || queue_.empty()) return;
  next_ = profile;
  planned_ = true;
}

void SegmentPath::begin_at(const Pose& pose, std::uint64_t now_us) {
  if (!continues_ || strayed(follower_.reference(), pose)) {
    follower_.begin_path(pose);
  } else {
    follower_.resume_path();
  }
  begin_next(now_us);
}

void SegmentPath::begin_next(std::uint64_t now_us) {
  running_ = queue_.pop();
  follower_.begin(next_);
  front_has_changed();
  settling_ticks_ = 0;
  settled_.reset();
  report(SegmentEvent::Kind::started, now_us);
}

// A segment goes from rest to rest: the next one begins when the wheels have stopped at its end, or when they will not get any
// closer.
bool SegmentPath::settled(bool wheels_stopped) {
  ++settling_ticks_;
  const bool rests = settled_.advance(wheels_stopped && follower_.close(), kSettled_ticks);
  return rests || settling_ticks_ >= kSettleAtMost_ticks;
}

void SegmentPath::end(std::uint64_t now_us) {
  Segment left;
  if (follower_.profile().was_cut()) left = follower_.profile().rest();
  if (left.length_nm != 0 || left.angle_32 != 0 || left.dwell_ms != 0) {
    left.speed_umps = running_.segment.speed_umps;
    left.yaw_rate_uradps = running_.segment.yaw_rate_uradps;
    queue_.push_front({left, running_.tag});
    front_has_changed();
  } else {
    report(SegmentEvent::Kind::completed, now_us);
  }
  continues_ = !queue_.empty();
}

}  // namespace astro
