#include "host/calibration/likelihood/slip_events.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host/base/order_statistics.hpp"
#include "host/calibration/preparation/path_alignment.hpp"

namespace astro::calibration {
namespace {

constexpr double kWindow_s = 0.5;
constexpr std::size_t kFewestSamples = 8;  // with fewer, the median follows a single wrong one
constexpr double kReach = 2;               // windows within which the samples of one median must lie
constexpr double kStepsPerWindow = 10;     // moments that are examined
constexpr double kLasting = 3;        // windows on either side after which an event must still be visible
constexpr double kFarDeviations = 8;  // in standard deviations of all moments
constexpr double kLeastUnseen_rad = 0.02;
constexpr std::size_t kMostEvents = 3;

struct Parting {
  double time_s = 0;
  std::size_t at = 0;  // sample of truth
  double turned_rad = 0;
};

/// Compares truth before and after each moment of a run, carried to that moment by the wheels.
class Moments {
 public:
  Moments(const PreparedRun& run, const Unknowns& u)
      : run_(run),
        odometry_(dead_reckoned(run, {u[kClockOffset], u[kSkew]}, factors_of(u))),
        period_s_(median_period_s(run.truth)),
        window_s_(std::max(kWindow_s, static_cast<double>(kFewestSamples) * period_s_)) {
    const Pose2 robot_in_body = lever_of(u).inverse();
    for (std::size_t k = 0; k < run.truth.size(); ++k) {
      Pose2 frame = pose_of(run.truth[k]) * robot_in_body * pose_of(odometry_[k]).inverse();
      if (k > 0) {
        // Without jumps by whole turns, so that neighbours can be compared as they stand.
        const double before_rad = frames_.back().theta_rad;
        frame.theta_rad = before_rad + wrapped_rad(frame.theta_rad - before_rad);
      }
      frames_.push_back(frame);
    }
  }

  double window_s() const { return window_s_; }

  /// The heading by a window that begins `gap` windows after a sample, minus the heading by a window that ends as
  /// long before it. Nothing if truth is missing there.
  std::optional<double> turned_rad(std::size_t at, double gap) const {
    const auto [before, after] = windows_about(at, gap);
    if (std::min(before.size(), after.size()) < kFewestSamples) return {};
    const auto turn_rad = [&](std::size_t k) { return frames_[k].theta_rad; };
    return wrapped_rad(middle(after, turn_rad) - middle(before, turn_rad));
  }

  /// How far the positions at a sample by the windows on both sides are apart. Precondition: turned_rad has an answer there.
  double moved_m(std::size_t at) const {
    const Windows windows = windows_about(at, 0);
    const auto apart = [&](double Point2::*coordinate) {
      const auto carried = [&](std::size_t k) { return carried_position(k, at).*coordinate; };
      return middle(windows.after, carried) - middle(windows.before, carried);
    };
    return std::hypot(apart(&Point2::x_m), apart(&Point2::y_m));
  }

  std::vector<Parting> all() const {
    std::vector<Parting> found;
    double next_s = run_.truth.front().time_s;
    for (std::size_t at = 0; at < run_.truth.size(); ++at) {
      if (run_.truth[at].time_s < next_s || run_.motion[at] == Motion::rest) continue;
      next_s = run_.truth[at].time_s + window_s_ / kStepsPerWindow;
      if (const auto turned = turned_rad(at, 0)) found.push_back({run_.truth[at].time_s, at, *turned});
    }
    return found;
  }

 private:
  std::size_t most() const {
    const double samples = period_s_ > 0 ? window_s_ / period_s_ : 1e3;
    return static_cast<std::size_t>(std::clamp(samples, static_cast<double>(kFewestSamples), 1e3));
  }

  /// Neighbouring samples begin..end-1.
  struct Range {
    std::size_t begin, end;

    std::size_t size() const { return end - begin; }
  };
  /// Samples before and after a sample.
  struct Windows {
    Range before, after;
  };

  Windows windows_about(std::size_t at, double gap) const {
    const auto time_s = [&](std::size_t k) { return run_.truth[k].time_s - run_.truth[at].time_s; };
    const double near_s = gap * window_s_, far_s = near_s + kReach * window_s_;
    const std::size_t most_samples = most();
    Range before{at, at}, after{at, at};
    while (before.end > 0 && time_s(before.end - 1) >= -near_s) --before.end;
    before.begin = before.end;
    while (before.begin > 0 && time_s(before.begin - 1) > -far_s && before.size() < most_samples)
      --before.begin;
    while (after.begin < run_.truth.size() && time_s(after.begin) < near_s) ++after.begin;
    after.end = after.begin;
    while (after.end < run_.truth.size() && time_s(after.end) < far_s && after.size() < most_samples)
      ++after.end;
    return {before, after};
  }

  /// The robot's position at sample `to` by the wheels, starting from its true pose at sample `from`.
  Point2 carried_position(std::size_t from, std::size_t to) const {
    return frames_[from] * Point2{odometry_[to].x_m, odometry_[to].y_m};
  }

  template <class Value>
  static double middle(const Range& samples, Value value) {
    std::vector<double> values;
    values.reserve(samples.size());
    for (std::size_t k = samples.begin; k < samples.end; ++k) values.push_back(value(k));
    return median_of(std::move(values));
  }

  const PreparedRun& run_;
  std::vector<BodySample> odometry_;
  std::vector<Pose2> frames_;  // of the odometry, seen from that of the truth, by each sample
  double period_s_, window_s_;
};

/// Keeps, of the moments of one event, the one with the largest rotation.
std::vector<SlipEvent> lasting(const Moments& moments, double start_s, std::vector<Parting> candidates) {
  std::vector<SlipEvent> found;
  const auto size = [](const Parting& parting) { return std::abs(parting.turned_rad); };
  while (!candidates.empty() && found.size() < kMostEvents) {
    const Parting here = *std::max_element(candidates.begin(), candidates.end(),
                                           [&](const auto& a, const auto& b) { return size(a) < size(b); });
    const auto later_rad = moments.turned_rad(here.at, kLasting);
    if (later_rad && *later_rad / here.turned_rad > 0.5)
      found.push_back({here.time_s, here.time_s - start_s, here.turned_rad, moments.moved_m(here.at)});
    std::erase_if(candidates, [&](const Parting& other) {
      return std::abs(other.time_s - here.time_s) < 2 * moments.window_s();
    });
  }
  std::sort(found.begin(), found.end(),
            [](const SlipEvent& a, const SlipEvent& b) { return a.time_s < b.time_s; });
  return found;
}

}  // namespace

std::vector<std::vector<SlipEvent>> find_slip_events(std::span<const PreparedRun> runs,
                                                     std::span<const Unknowns> unknowns) {
  std::vector<std::optional<Moments>> moments(runs.size());
  std::vector<std::vector<Parting>> partings(runs.size());
  std::vector<double> turned_rad;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].has_headings || runs[i].truth.size() < 2 * kFewestSamples) continue;
    partings[i] = moments[i].emplace(runs[i], unknowns[i]).all();
    for (const Parting& parting : partings[i]) turned_rad.push_back(parting.turned_rad);
  }
  std::vector<std::vector<SlipEvent>> found(runs.size());
  if (turned_rad.empty()) return found;
  const double far_rad = std::max(kLeastUnseen_rad, kFarDeviations * deviation_of(turned_rad));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::erase_if(partings[i], [&](const Parting& each) { return std::abs(each.turned_rad) < far_rad; });
    if (!partings[i].empty())
      found[i] = lasting(*moments[i], runs[i].source->truth.front().time_s, partings[i]);
  }
  return found;
}

}  // namespace astro::calibration
