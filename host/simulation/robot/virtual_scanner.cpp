#include "host/simulation/robot/virtual_scanner.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/require_positive.hpp"

namespace astro::simulation {
namespace {

constexpr std::size_t kMostScans = 512;
constexpr double kNanosPerMicro = 1000;

const ScannerConfig& checked(const ScannerConfig& config) {
  require_positive(config.beams, "the number of beams in a turn of a scanner");
  require_positive(config.turns_per_s, "the rate of a scanner in turns per second");
  require_positive(config.range_max_m - config.range_min_m, "the span of a scanner's ranges in metres");
  return config;
}

}  // namespace

VirtualScanner::VirtualScanner(const Room& room, const ScannerConfig& config)
    : config_(checked(config)),
      rays_(room),
      random_(config.seed),
      beam_us_(1e6 / (config.turns_per_s * config.beams)) {}

double VirtualScanner::angle_step_rad() const {
  return (config_.clockwise ? -2 : 2) * std::numbers::pi / config_.beams;
}

void VirtualScanner::advance(std::uint64_t time_us, const Pose2& robot) {
  const Moment now{static_cast<double>(time_us), robot};
  beams_.clear();
  if (!last_) {
    first_us_ = now.time_us;
    last_ = now;
  }
  const double span_us = now.time_us - last_->time_us;
  // Computed from the turn's first beam, so that the interval's rounding does not add up.
  for (double at_us; (at_us = first_us_ + index_ * beam_us_) <= now.time_us;) {
    if (beams_.empty()) rays_.move_people(at_us * 1e-6);
    const double share = span_us > 0 ? (at_us - last_->time_us) / span_us : 1;
    const Pose2& before = last_->robot;
    keep(shoot(at_us,
               {before.x_m + share * (robot.x_m - before.x_m), before.y_m + share * (robot.y_m - before.y_m),
                before.theta_rad + share * (robot.theta_rad - before.theta_rad)}));
  }
  last_ = now;
}

VirtualScanner::Beam VirtualScanner::shoot(double time_us, const Pose2& robot) {
  const Pose2 scanner = robot * config_.mount;
  const double angle_rad = index_ * angle_step_rad();
  const double direction_rad = scanner.theta_rad + (config_.upside_down ? -angle_rad : angle_rad);
  double range_m =
      rays_.distance_m({scanner.x_m, scanner.y_m}, std::cos(direction_rad), std::sin(direction_rad));
  if (std::isfinite(range_m))
    range_m += std::max(config_.least_sd_m, config_.range_sd * range_m) * normal_(random_);
  // Two random numbers for each beam that meets something, whatever comes of it: a setting changes no other beam.
  const bool missing = uniform(random_) < config_.missing;
  if (missing || !(range_m >= config_.range_min_m && range_m <= config_.range_max_m))
    range_m = std::numeric_limits<double>::quiet_NaN();
  return {time_us, index_, static_cast<float>(range_m)};
}

void VirtualScanner::keep(const Beam& beam) {
  if (beam.index == 0)
    turn_ = {.time_ns = std::llround(kNanosPerMicro * beam.time_us),
             .first_angle_rad = 0,
             .angle_step_rad = angle_step_rad(),
             .beam_interval_s = 1e-6 * beam_us_,
             .range_min_m = config_.range_min_m,
             .range_max_m = config_.range_max_m,
             .ranges_m = {}};
  beams_.push_back(beam);
  turn_.ranges_m.push_back(beam.range_m);
  if (++index_ < config_.beams) return;
  index_ = 0;
  first_us_ += config_.beams * beam_us_;
  if (scans_.size() >= kMostScans) scans_.erase(scans_.begin(), scans_.begin() + kMostScans / 2);
  scans_.push_back(std::exchange(turn_, {}));
}

std::vector<lidar::Scan> VirtualScanner::take_scans() { return std::exchange(scans_, {}); }

void VirtualScanner::restart_clock() {
  last_.reset();
  index_ = 0;
}

}  // namespace astro::simulation
