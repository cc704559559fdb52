#pragma once

#include <chrono>
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

/// The link for the URL's scheme. Throws astro::Error if the host's name is unknown.
std::unique_ptr<TrackerLink> open_link(const TrackerUrl& url);

/// A tracker on the network as a source of ground truth. Its times are on this computer's steady clock.
///
/// Start   the constructor waits until poses come, and listens to them for a moment to choose between the
///         sender's times and the times of arrival (stamps.hpp). Without poses it throws with the likely cause.
/// Lost    if the body or the connection is lost during a drive, samples are invalid or missing; the link
///         connects again by itself. poll() throws once nothing has come for ten seconds of
///         listening; it need not be called while nothing is recorded.
/// Axes    poll() throws if the drive shows that another axis points up than the URL says.
class LiveSource : public Source {
 public:
  using Now = std::function<std::chrono::microseconds()>;
  static std::chrono::microseconds steady_now();

  explicit LiveSource(const TrackerUrl& url) : LiveSource(url, open_link(url), steady_now) {}
  /// Throws astro::Error that says why no pose comes, or which bodies there are if none was named.
  LiveSource(TrackerUrl url, std::unique_ptr<TrackerLink> link, Now now);

  std::vector<recording::TruthSample> poll() override;
  std::string name() const override { return url_.scheme; }
  std::string clock() const override { return "host"; }
  std::string description() const override;

 private:
  void listen_at_first();
  void require_one_body() const;
  bool take_some(std::chrono::microseconds now);
  void take(const Sighting& sighting);

  TrackerUrl url_;
  std::unique_ptr<TrackerLink> link_;
  Now now_;
  FloorTrack floor_;
  UpAxisCheck up_axis_;
  std::optional<TrackerClock> clock_;
  int connections_ = 0;
  std::chrono::microseconds heard_at_{}, polled_at_{};
  std::vector<recording::TruthSample> samples_;  // not yet polled
};

}  // namespace astro::truth
