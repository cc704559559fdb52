#include "host/truth/live/live_source.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/base/error.hpp"
#include "host/truth/live/natnet_link.hpp"
#include "host/truth/live/vrpn_link.hpp"

namespace astro::truth {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr microseconds kFirstPoseTimeout =
    seconds(6);  // a connection attempt, a call back, and a second to describe
constexpr microseconds kFirstListening = milliseconds(700);
constexpr std::size_t kMostFirst = 100;
constexpr microseconds kGone = seconds(10);
constexpr microseconds kPause =
    seconds(1);  // between two polls: a person is asked something, or the robot waits
constexpr microseconds kStep = milliseconds(20);

/// A link that has passed on poses knows no reason why none comes any more.
std::string why_silent(const TrackerLink& link) {
  const std::string why = link.why_silent();
  return why.empty() ? "it has stopped sending" : why;
}
// Of what the network has kept while nobody polled: minutes. A tracker that sends without end cannot keep us.
constexpr int kMostRounds = 64;

}  // namespace

std::unique_ptr<TrackerLink> open_link(const TrackerUrl& url) {
  if (url.scheme == "natnet") return std::make_unique<NatNetLink>(url);
  return std::make_unique<VrpnLink>(url);
}

microseconds LiveSource::steady_now() {
  return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
}

LiveSource::LiveSource(TrackerUrl url, std::unique_ptr<TrackerLink> link, Now now)
    : url_(std::move(url)), link_(std::move(link)), now_(std::move(now)), floor_(url_.up), up_axis_(url_.up) {
  listen_at_first();
}

/// The times of the first poses show which clock is the more regular one.
void LiveSource::listen_at_first() {
  const microseconds begin = now_();
  std::vector<Sighting> first;
  std::optional<microseconds> first_at;
  const auto enough = [&] {
    return first.size() >= kMostFirst || (first_at && now_() - *first_at >= kFirstListening);
  };
  while (!enough()) {
    link_->work(now_());
    for (Sighting& sighting : link_->take()) first.push_back(sighting);
    if (!first.empty() && !first_at) first_at = now_();
    if (!first_at && now_() - begin >= kFirstPoseTimeout)
      throw Error(fmt::format("no ground truth comes from {}: {}", url_.place(), why_silent(*link_)));
    link_->wait(kStep);
  }
  require_one_body();
  std::vector<Stamp> stamps;
  for (const Sighting& sighting : first) stamps.push_back(sighting.stamp);
  clock_.emplace(stamps);
  connections_ = link_->connections();
  polled_at_ = now_();
  for (const Sighting& sighting : first) take(sighting);
}

void LiveSource::require_one_body() const {
  if (!url_.body.empty() || link_->bodies().size() < 2) return;
  std::string list;
  for (const std::string& body : link_->bodies()) list += (list.empty() ? "'" : ", '") + body + "'";
  throw Error(fmt::format("{} tracks several bodies, and none was named: {}", url_.place(), list));
}

void LiveSource::take(const Sighting& sighting) {
  heard_at_ = microseconds(sighting.stamp.arrival_us);
  samples_.push_back(floor_.take(clock_->host_time_us(sighting.stamp), sighting.pose, sighting.tracked));
  if (samples_.back().valid) up_axis_.take(sighting.pose);
}

/// Returns false if nothing has come.
bool LiveSource::take_some(microseconds now) {
  link_->work(now);
  const std::vector<Sighting> sightings = link_->take();
  if (link_->connections() != connections_) clock_->restart();
  connections_ = link_->connections();
  for (const Sighting& sighting : sightings) take(sighting);
  return !sightings.empty();
}

std::vector<recording::TruthSample> LiveSource::poll() {
  const microseconds now = now_();
  const bool paused = now - std::exchange(polled_at_, now) > kPause;
  if (paused) heard_at_ = now;  // nobody listened meanwhile
  for (int i = 0; i < kMostRounds && take_some(now); ++i) {
  }
  if (paused) up_axis_.forget();
  if (const auto objection = up_axis_.objection()) throw Error(*objection);
  if (now - heard_at_ >= kGone)
    throw Error(fmt::format("no ground truth has come from {} for {} s: {}", url_.place(),
                            std::chrono::duration_cast<seconds>(kGone).count(), why_silent(*link_)));
  return std::exchange(samples_, {});
}

std::string LiveSource::description() const {
  const Regularity& sender = clock_->sender();
  const Regularity& arrival = clock_->arrival();
  const Regularity& used = clock_->is_senders() ? sender : arrival;
  return fmt::format("'{}' from {} {}, {:.1f} poses per second, times {} (jitter {:.2f} ms, {} {:.2f} ms)",
                     link_->body(), url_.place(), link_->way(), 1 / used.period_s,
                     clock_->is_senders() ? "by the tracker's clock" : "of arrival", 1e3 * used.jitter_s,
                     clock_->is_senders() ? "of arrival" : "by the tracker's clock",
                     1e3 * (clock_->is_senders() ? arrival : sender).jitter_s);
}

}  // namespace astro::truth
