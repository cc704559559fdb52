#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "host/base/error.hpp"
#include "host/base/pose2.hpp"
#include "host/truth/live/sighting.hpp"
#include "host/truth/live/up_axis_check.hpp"

namespace astro::truth {

/// Scatter of a body that stands still.
struct LiveNoise {
  double position_m = 0;  // standard deviation per coordinate
  double heading_rad = 0;
};

/// What the last seconds of a tracker's poses were like.
struct TrackerReport {
  std::size_t poses = 0, lost = 0;  // received; of these without the body
  double rate_hz = 0;               // of the frames, missing ones included
  std::size_t missing = 0;          // frames that did not come, by the more regular clock
  double longest_gap_s = 0;         // between two poses with the body
  Regularity sender, arrival;       // the two clocks by which samples can be stamped
  std::optional<Pose2> pose;        // the last one with the body
  std::optional<LiveNoise> rest;    // nothing while the body moves
  std::optional<Remark> objection;  // to the axis that is taken for up, from all that was seen
};

/// Keeps the last few seconds of a tracker's poses and summarises them. If a tracker sends faster than any can measure, it
/// keeps the last 30,000 poses.
class TrackerWatch {
 public:
  /// `span_us`: how long a pose counts after its arrival.
  explicit TrackerWatch(UpAxis up, std::int64_t span_us = 3'000'000)
      : up_(up), up_axis_(up), span_us_(span_us) {}

  void take(const Sighting& sighting);
  /// `now_us`: on the clock of the arrivals. What is older than the span is forgotten.
  TrackerReport report(std::int64_t now_us);

 private:
  struct Seen {
    Stamp stamp;
    std::optional<Pose2> pose;  // nothing: lost
  };
  std::optional<LiveNoise> rest() const;

  UpAxis up_;
  UpAxisCheck up_axis_;
  std::int64_t span_us_;
  std::deque<Seen> seen_;
  std::optional<Pose3> last_;
};

}  // namespace astro::truth
