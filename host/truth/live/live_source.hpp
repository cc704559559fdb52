#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/truth/live/tracker_link.hpp"
#include "host/truth/live/tracker_url.hpp"
#include "host/truth/live/up_axis_check.hpp"
#include "host/truth/source/floor_track.hpp"
#include "host/truth/source/source.hpp"

namespace astro::truth {

/// Why no ground truth comes, or cannot be taken. The first value is the tracker's place.
enum class LiveProblem {
  tracker_silent,  // then why, as its link says it, and for a silence within a run its seconds
  poses_ended,     // then the body, and for a silence within a run its seconds
  body_unseen,     // the same
  several_bodies,  // then their names
  too_many_poses   // then how many per second are possible
};

/// The link for the URL's scheme. Throws astro::Error if the host's name is unknown, or if a variable of ROS 2 in the
/// environment has an impossible value.
std::unique_ptr<TrackerLink> open_link(const TrackerUrl& url);

/// A tracker on the network as a source of ground truth. Its times are on this computer's steady clock, and never run
/// backwards between two calls of begin_run().
///
/// Start   the constructor waits until poses come, and listens to them for a moment to choose between the
///         sender's times and the times of arrival (stamps.hpp). Without poses it throws with the likely cause.
/// Run     begin_run() returns once the tracker sees the body now, at the latest after seven seconds, and throws if it
///         does not. It chooses again between the two times, by the last seconds: only here may the mapping of the
///         sender's clock change.
/// Lost    if the body or the connection is lost during a drive, samples are invalid or missing; the link
///         connects again by itself. The first samples after that come a little later, because the sender's clock may
///         be another one. poll() throws once nothing has come for ten seconds. It need not be called while nothing is
///         recorded, if begin_run() is called before the next recording.
/// Bounds  poll() throws if more poses come than any tracker measures, 10,000 per second.
/// Axes    poll() throws if the drive shows that another axis points up than the URL says.
class LiveSource : public Source {
 public:
  using Now = std::function<std::chrono::microseconds()>;
  static std::chrono::microseconds steady_now();

  /// Uses a ListeningLink, so that poses are stamped when they arrive, and not when they are polled.
  explicit LiveSource(const TrackerUrl& url);
  /// Throws astro::Error that says why no pose comes, or which bodies there are if none was named.
  LiveSource(TrackerUrl url, std::unique_ptr<TrackerLink> link, Now now);

  void begin_run() override;
  std::vector<recording::TruthSample> poll() override;
  std::string name() const override { return url_.scheme; }
  std::string clock() const override { return "host"; }
  std::string description() const override;

 private:
  enum class Need { any_pose, body_seen_now };
  struct Heard {
    Stamp stamp;
    recording::TruthSample sample;  // all but its time
  };

  void listen(Need need);
  void require_one_body() const;
  bool work(std::chrono::microseconds now);
  void take(const Sighting& sighting);
  void remember(const Stamp& stamp);
  void expect_another_clock();
  void settle(std::chrono::microseconds now);
  void pass_on(const Heard& heard);
  void pass_on_held();
  void begin_counting();
  void require_possible_rate();
  [[noreturn]] void refuse_silence() const;
  /// The clause that ends an error, with the kind and the values of the error.
  Remark why_missing() const;

  TrackerUrl url_;
  std::unique_ptr<TrackerLink> link_;
  Now now_;
  FloorTrack floor_;
  UpAxisCheck up_axis_;
  std::optional<TrackerClock> clock_;
  bool mapped_ = false;       // otherwise the clock has yet to be chosen or continued, by `recent_`
  std::deque<Stamp> recent_;  // of one clock of the sender
  Waiting<Heard> held_;       // until it is mapped
  int connections_ = 0;
  std::chrono::microseconds heard_at_{};
  std::optional<std::int64_t> last_us_;          // of this run's samples
  std::vector<recording::TruthSample> samples_;  // not yet polled
  std::int64_t passed_on_ = 0;                   // samples since then
  std::chrono::microseconds counting_from_{};
};

}  // namespace astro::truth
