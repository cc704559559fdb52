#include "host/page/robot/path_drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/robot/client/refusal.hpp"
#include "host/robot/motion/other_program.hpp"

namespace astro::page {
namespace {

// An event must have been lost by then, or the segment is long.
constexpr microseconds kAsk = std::chrono::seconds(1);

}  // namespace

PathDrive::PathDrive(live::RobotSession& session, robot::Path path)
    : session_(session), path_(std::move(path)), heard_at_(session.client().now()) {
  for (std::size_t i = 0; i < path_.size(); ++i) path_[i].tag = static_cast<std::uint16_t>(i + 1);
  on_done_ = session_.client().on<protocol::SegmentDone>([this](const protocol::SegmentDone& done) {
    if (done.outcome == protocol::SegmentOutcome::aborted) {
      ended_ = ended_.value_or("the robot was stopped on its way");
      return;
    }
    done_ = std::max<std::size_t>(done_, done.tag);
    heard_at_ = session_.client().now();
  });
  step();
}

void PathDrive::step() {
  if (ended_) return;
  fill();
  if (!ended_ && done_ < path_.size() && session_.client().now() - heard_at_ > kAsk) ask();
  if (!ended_ && done_ >= path_.size()) ended_ = kFinished;
}

void PathDrive::fill() {
  // A robot whose queue was full has room again once a segment was done.
  constexpr std::size_t kMostAtOnce = 4;  // beyond those that are done, so that a step is short
  while (accepted_ < std::min(path_.size(), done_ + kMostAtOnce)) try {
      session_.ask(path_[accepted_]);
      ++accepted_;
      heard_at_ = session_.client().now();
    } catch (const robot::RobotRefused& refused) {
      if (refused.code() == protocol::ErrorCode::queue_full) return;
      ended_ = robot::why_refused(session_.client(), refused).sentence;
      return;
    }
}

/// An event that was lost does not leave the path under way for ever.
void PathDrive::ask() {
  heard_at_ = session_.client().now();
  const protocol::Status status = session_.ask(protocol::GetStatus{});
  if (status.latched_faults != 0)
    ended_ = "the robot stopped by itself: " + robot::fault_names(status.latched_faults);
  else if (status.mode == protocol::Mode::disarmed)
    ended_ = "the robot was disarmed";
  else if (status.mode == protocol::Mode::idle && status.queued_segments == 0)
    end_at_rest();
}

/// The robot refuses the Rest if somebody has stopped it.
void PathDrive::end_at_rest() try {
  session_.ask(protocol::Rest{});
  done_ = accepted_;
} catch (const robot::RobotRefused& refused) {
  ended_ = robot::why_refused(session_.client(), refused).sentence;
}

double PathDrive::done(const protocol::Telemetry& newest) const {
  // Telemetry may say earlier than the event that the next segment runs.
  const double driven = newest.path.tag > done_
                            ? newest.path.tag - 1 + std::ldexp(static_cast<double>(newest.path.progress), -15)
                            : static_cast<double>(done_);
  return std::min(1.0, driven / static_cast<double>(path_.size()));
}

}  // namespace astro::page
