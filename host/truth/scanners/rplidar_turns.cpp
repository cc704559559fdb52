#include "host/truth/scanners/rplidar_turns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "host/base/pose2.hpp"

namespace astro::truth::rplidar {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNothing_m = std::numeric_limits<double>::quiet_NaN();

constexpr double kWindow_us = 8e6, kLeastSpan_us = 5e5;
constexpr std::size_t kLeastArrivals = 20, kMostArrivals = 16'384;
constexpr double kBacklog_us = 5e4;       // later than a scheduler usually makes an arrival
constexpr double kFarFromNominal = 0.25;  // of the nominal period

// A turn has at least one beam in 9 degrees; more than 10,000 measurements without a start flag are no turn.
constexpr std::size_t kLeastNodes = 40, kMostNodes = 10'000;
constexpr double kOffTurn_rad =
    0.4;  // by which a turn's angles may miss 2 pi, as corrections differ at its ends
constexpr std::size_t kMostTurns = 512;

/// Neighbours whose ranges differ by more than this share are of two surfaces: at one degree a wall would be met at 80 degrees.
constexpr double kStep = 0.1;
constexpr double kWidestGap = 3;    // in beams, across which a line is drawn
constexpr double kCloseBy = 0.25;   // in beams: the nearer measurement counts for the beam
constexpr double kAtTheEnds = 0.5;  // the same beyond the first and last measurement

/// A measurement with its angle counted on from the turn's first one.
struct Sight {
  double angle_rad = 0, range_m = 0;
};

std::vector<Sight> sights_of(const std::vector<Node>& turn) {
  std::vector<Sight> sights;
  double angle_rad = turn.front().angle_rad;
  for (const Node& node : turn) {
    angle_rad += wrapped_rad(node.angle_rad - angle_rad);
    sights.push_back({angle_rad, node.range_m});
  }
  return sights;
}

/// Angles as first + step i, by least squares.
struct Spacing {
  double first_rad = 0, step_rad = 0;
};

Spacing spacing_of(const std::vector<Sight>& sights) {
  const auto n = static_cast<double>(sights.size());
  double sum = 0, moment = 0;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    sum += sights[i].angle_rad;
    moment += sights[i].angle_rad * (static_cast<double>(i) - (n - 1) / 2);
  }
  const double step_rad = moment * 12 / (n * (n * n - 1));
  return {sum / n - step_rad * (n - 1) / 2, step_rad};
}

/// Where the ray at this angle crosses the straight line between two measurements.
double on_line_m(const Sight& a, const Sight& b, double angle_rad) {
  return a.range_m * b.range_m * std::sin(b.angle_rad - a.angle_rad) /
         (a.range_m * std::sin(angle_rad - a.angle_rad) + b.range_m * std::sin(b.angle_rad - angle_rad));
}

double near_by_m(const Sight& sight, double angle_rad, double within_rad) {
  return sight.range_m > 0 && std::abs(sight.angle_rad - angle_rad) <= within_rad ? sight.range_m
                                                                                  : kNothing_m;
}

double between_m(const Sight& a, const Sight& b, double angle_rad, double step_rad) {
  const bool both = a.range_m > 0 && b.range_m > 0 && b.angle_rad - a.angle_rad <= kWidestGap * step_rad;
  if (both && std::abs(a.range_m - b.range_m) <= kStep * std::min(a.range_m, b.range_m))
    return a.angle_rad == b.angle_rad ? a.range_m : on_line_m(a, b, angle_rad);
  const bool first = angle_rad - a.angle_rad <= b.angle_rad - angle_rad;
  return near_by_m(first ? a : b, angle_rad, kCloseBy * step_rad);
}

std::vector<float> evenly_spaced(std::vector<Sight> sights, const Spacing& spacing) {
  std::ranges::stable_sort(sights, {}, &Sight::angle_rad);
  std::vector<float> ranges_m;
  auto next = sights.begin();  // the first measurement at a greater angle
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const double angle_rad = spacing.first_rad + static_cast<double>(i) * spacing.step_rad;
    while (next != sights.end() && next->angle_rad <= angle_rad) ++next;
    const bool inside = next != sights.begin() && next != sights.end();
    const Sight& end = next == sights.begin() ? sights.front() : sights.back();
    ranges_m.push_back(static_cast<float>(inside ? between_m(*(next - 1), *next, angle_rad, spacing.step_rad)
                                                 : near_by_m(end, angle_rad, kAtTheEnds * spacing.step_rad)));
  }
  return ranges_m;
}

}  // namespace

void SampleClock::arrived(std::int64_t count, std::chrono::microseconds at) {
  if (!arrivals_.empty() && arrivals_.back().count == count) return;
  const Arrival last{count, static_cast<double>(at.count())};
  const auto begun_us = [&](const Arrival& arrival) {
    return arrival.time_us - 1e6 * period_s_ * static_cast<double>(arrival.count);
  };
  // What had waited while the computer looked elsewhere tells nothing of the rate. Until the rate was measured, the scanner may be
  // as much faster than it says as is believed of any.
  const auto slack_us = [&](const Arrival& arrival) {
    return kBacklog_us +
           (measured_ ? 0
                      : 1e6 * kFarFromNominal * nominal_s_ * static_cast<double>(last.count - arrival.count));
  };
  while (!arrivals_.empty() && begun_us(arrivals_.front()) > begun_us(last) + slack_us(arrivals_.front()))
    arrivals_.pop_front();
  arrivals_.push_back(last);
  while (arrivals_.size() > kMostArrivals ||
         arrivals_.back().time_us - arrivals_.front().time_us > kWindow_us)
    arrivals_.pop_front();
}

void SampleClock::restart() { arrivals_.clear(); }

bool SampleClock::settled() const {
  return arrivals_.size() >= kLeastArrivals &&
         arrivals_.back().time_us - arrivals_.front().time_us >= kLeastSpan_us;
}

void SampleClock::update() {
  if (arrivals_.empty()) return;
  const Arrival& first = arrivals_.front();
  if (settled()) {
    double n = 0, count = 0, time = 0, square = 0, product = 0;
    for (const Arrival& arrival : arrivals_) {
      const double x = static_cast<double>(arrival.count - first.count), y = arrival.time_us - first.time_us;
      n += 1, count += x, time += y, square += x * x, product += x * y;
    }
    const double slope_s = 1e-6 * (n * product - count * time) / (n * square - count * count);
    measured_ = std::abs(slope_s - nominal_s_) <= kFarFromNominal * nominal_s_;
    period_s_ = measured_ ? slope_s : nominal_s_;
  }
  start_us_ = std::numeric_limits<double>::infinity();
  for (const Arrival& arrival : arrivals_)
    start_us_ =
        std::min(start_us_, arrival.time_us - 1e6 * period_s_ * static_cast<double>(arrival.count - 1));
}

TurnAssembler::TurnAssembler(double sample_s, double delay_s, Range range)
    : clock_(sample_s), delay_s_(delay_s), range_(range) {}

void TurnAssembler::add(const std::vector<Node>& nodes, std::int64_t received, std::chrono::microseconds at) {
  const bool lost = std::ranges::any_of(nodes, [](const Node& node) { return !node.follows; });
  if (!lost) clock_.arrived(received, at);
  for (const Node& node : nodes) {
    if (!node.follows && clock_.started()) {  // turns from before are on the clock from before
      stamp_turns();
      clock_.restart();
    }
    if (!node.follows || turn_.size() >= kMostNodes) whole_ = false;
    if (!whole_ && !node.starts_turn) continue;
    if (node.starts_turn) {
      if (whole_) finish_turn();
      turn_.clear();
      whole_ = true;
    }
    turn_.push_back(node);
  }
  if (lost) clock_.arrived(received, at);
  if (!ended_.empty() && clock_.settled()) stamp_turns();
}

void TurnAssembler::finish_turn() {
  if (turn_.size() < kLeastNodes) return;
  const std::vector<Sight> sights = sights_of(turn_);
  const Spacing spacing = spacing_of(sights);
  const double turned_rad = spacing.step_rad * static_cast<double>(sights.size());
  if (std::abs(turned_rad - 2 * kPi) > kOffTurn_rad) return;
  lidar::Scan scan;
  scan.first_angle_rad = -spacing.first_rad;  // an RPLIDAR counts angles clockwise
  scan.angle_step_rad = -spacing.step_rad;
  scan.range_min_m = range_.min_m;
  scan.range_max_m = range_.max_m;
  scan.ranges_m = evenly_spaced(sights, spacing);
  ended_.push_back({turn_.front().count, std::move(scan)});
}

void TurnAssembler::stamp_turns() {
  clock_.update();
  for (Turn& turn : std::exchange(ended_, {})) {
    turn.scan.time_ns = std::llround(1e3 * clock_.time_us(turn.count) - 1e9 * delay_s_);
    turn.scan.beam_interval_s = clock_.period_s();
    // After a computer that looked very late the clock may find that it was ahead.
    if (turn.scan.time_ns <= last_ns_) continue;
    last_ns_ = turn.scan.time_ns;
    if (scans_.size() >= kMostTurns) scans_.erase(scans_.begin(), scans_.begin() + kMostTurns / 2);
    scans_.push_back(std::move(turn.scan));
  }
}

std::vector<lidar::Scan> TurnAssembler::take() { return std::exchange(scans_, {}); }

}  // namespace astro::truth::rplidar
