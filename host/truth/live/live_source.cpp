#include "host/truth/live/live_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/base/error.hpp"
#include "host/truth/live/listening_link.hpp"
#include "host/truth/live/natnet_link.hpp"
#include "host/truth/live/ros_link.hpp"
#include "host/truth/live/vrpn_link.hpp"

namespace astro::truth {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr microseconds kPoseTimeout =
    seconds(6);  // a connection attempt, a call back, and a second to describe
constexpr microseconds kListening = milliseconds(700);  // to choose the clock
constexpr microseconds kSettling = milliseconds(300);   // to see the shortest delay of another clock
constexpr microseconds kRecent = seconds(3);
constexpr std::size_t kMostRecent = 4096;
constexpr microseconds kGone = seconds(10);
constexpr microseconds kStep = milliseconds(20);

// The most rounds of reading in one call. They are enough for what the network has buffered in minutes, and a
// tracker that sends without end cannot block us.
constexpr int kMostRounds = 64;

}  // namespace

std::unique_ptr<TrackerLink> open_link(const TrackerUrl& url) {
  if (url.scheme == "ros2") return std::make_unique<RosLink>(url);
  if (url.scheme == "natnet") return std::make_unique<NatNetLink>(url);
  return std::make_unique<VrpnLink>(url);
}

microseconds LiveSource::steady_now() {
  return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
}

LiveSource::LiveSource(const TrackerUrl& url)
    : LiveSource(url, std::make_unique<ListeningLink>(open_link(url), steady_now), steady_now) {}

LiveSource::LiveSource(TrackerUrl url, std::unique_ptr<TrackerLink> link, Now now)
    : url_(std::move(url)), link_(std::move(link)), now_(std::move(now)), floor_(url_.up), up_axis_(url_.up) {
  begin_counting();
  listen(Need::any_pose);
}

void LiveSource::begin_run() {
  held_.clear();
  samples_.clear();
  last_us_.reset();
  begin_counting();
  listen(Need::body_seen_now);
  up_axis_.forget();  // somebody may have carried the body until now
}

/// Waits for poses, and chooses the clock. What the system has buffered before is read first, because it
/// shows neither that poses come now nor how late they are.
void LiveSource::listen(Need need) {
  const microseconds begin = now_();
  mapped_ = false;
  for (int i = 0; i < kMostRounds && work(begin); ++i) {
  }
  if (need == Need::body_seen_now) held_.clear();
  const auto enough = [&](const Heard& heard) { return need == Need::any_pose || heard.sample.valid; };
  while (std::ranges::none_of(held_.all(), enough) ||
         now_().count() - recent_.front().arrival_us < kListening.count()) {
    if (now_() - begin >= kPoseTimeout && std::ranges::none_of(held_.all(), enough))
      throw Error(why_missing().in(fmt::format("no ground truth comes from {}: ", url_.place())));
    link_->wait(kStep);
    work(now_());
  }
  require_one_body();
  clock_.emplace(std::vector<Stamp>(recent_.begin(), recent_.end()));
  pass_on_held();
}

void LiveSource::require_one_body() const {
  if (!url_.body.empty() || link_->bodies().size() < 2) return;
  std::string list;
  std::vector<std::string> values{url_.place()};
  for (const std::string& body : link_->bodies()) {
    list += (list.empty() ? "'" : ", '") + body + "'";
    values.push_back(body);
  }
  throw Error(fmt::format("{} tracks several bodies, and none was named: {}", url_.place(), list),
              LiveProblem::several_bodies, values);
}

/// Returns false if nothing has come.
bool LiveSource::work(microseconds now) {
  link_->work(now);
  const std::vector<Sighting> sightings = link_->take();
  if (std::exchange(connections_, link_->connections()) != connections_) {
    if (clock_) clock_->restart();
    expect_another_clock();
  }
  for (const Sighting& sighting : sightings) take(sighting);
  return !sightings.empty();
}

void LiveSource::take(const Sighting& sighting) {
  heard_at_ = microseconds(sighting.stamp.arrival_us);
  if (clock_ && !clock_->follows(sighting.stamp)) expect_another_clock();
  remember(sighting.stamp);
  const Heard heard{sighting.stamp, floor_.take(0, sighting.pose, sighting.tracked)};
  if (heard.sample.valid) up_axis_.take(sighting.pose);
  if (!mapped_) return held_.push(heard);
  pass_on(heard);
}

void LiveSource::remember(const Stamp& stamp) {
  recent_.push_back(stamp);
  while (recent_.size() > kMostRecent || stamp.arrival_us - recent_.front().arrival_us > kRecent.count())
    recent_.pop_front();
}

void LiveSource::expect_another_clock() {
  recent_.clear();
  held_.clear();
  mapped_ = mapped_ && !clock_->is_senders();  // arrival times do not use the sender's clock
}

/// Continues the mapping once enough samples of the sender's other clock have come, so that the shortest
/// delay is among them.
void LiveSource::settle(microseconds now) {
  if (mapped_ || recent_.empty() || now.count() - recent_.front().arrival_us < kSettling.count()) return;
  clock_->continue_with(std::vector<Stamp>(recent_.begin(), recent_.end()));
  pass_on_held();
}

void LiveSource::pass_on_held() {
  mapped_ = true;
  for (const Heard& heard : held_.take()) pass_on(heard);
}

void LiveSource::begin_counting() {
  passed_on_ = 0;
  counting_from_ = now_();
}

/// Poses that came while this program was stopped are read all at once, so the rate is averaged since the
/// beginning of the run.
void LiveSource::require_possible_rate() {
  constexpr std::int64_t kMostPerSecond = 10'000, kMostAtOnce = 100'000;
  const std::int64_t passed_s = std::chrono::duration_cast<seconds>(now_() - counting_from_).count();
  if (++passed_on_ > kMostAtOnce + kMostPerSecond * passed_s)
    throw Error(fmt::format("more than {} poses per second come from {}, and no tracker measures so fast",
                            kMostPerSecond, url_.place()),
                LiveProblem::too_many_poses, {url_.place(), std::to_string(kMostPerSecond)});
}

/// Datagrams may overtake each other; a sample that is older than the last one is left out.
void LiveSource::pass_on(const Heard& heard) {
  recording::TruthSample sample = heard.sample;
  sample.time_us = clock_->host_time_us(heard.stamp);
  if (last_us_ && sample.time_us < *last_us_) return;
  last_us_ = sample.time_us;
  samples_.push_back(sample);
  require_possible_rate();
}

std::vector<recording::TruthSample> LiveSource::poll() {
  const microseconds now = now_();
  for (int i = 0; i < kMostRounds && work(now); ++i) {
  }
  settle(now);
  if (const auto objection = up_axis_.objection()) throw Error(*objection);
  if (now - heard_at_ >= kGone) refuse_silence();
  return std::exchange(samples_, {});
}

void LiveSource::refuse_silence() const {
  const std::string silence_s = std::to_string(std::chrono::duration_cast<seconds>(kGone).count());
  Remark why =
      why_missing().in(fmt::format("no ground truth has come from {} for {} s: ", url_.place(), silence_s));
  why.values.push_back(silence_s);
  throw Error(why);
}

Remark LiveSource::why_missing() const {
  const std::string& body = link_->body();
  if (!held_.all().empty())
    return {"'" + body + "' is not seen, or has the same pose again and again",
            LiveProblem::body_unseen,
            {url_.place(), body}};
  const std::string why = link_->why_silent();
  if (!why.empty()) return {why, LiveProblem::tracker_silent, {url_.place(), why}};
  return {"no more poses of '" + body + "' are sent", LiveProblem::poses_ended, {url_.place(), body}};
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
