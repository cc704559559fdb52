#include "host/calibration/motion/motion_match.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace astro::calibration {
namespace {

// In variances of the noise: a motion of truth below this is not distinguishable from noise.
constexpr double kLeastMotion = 3;

constexpr int kLongestRow = 256;  // bins that are added up at once: few enough to stay in the cache

double part(double some, double all) { return all > 0 ? std::clamp(some / all, 0.0, 1.0) : 0; }

double cosine(double both, double wheels, double truth) {
  return wheels > 0 && truth > 0 ? both / std::sqrt(wheels * truth) : -1;
}

}  // namespace

/// Subtracts the means from the profile and returns them.
MotionMatch::Whole MotionMatch::centred(MotionProfile& profile) {
  Whole whole;
  for (std::size_t i = 0; i < profile.known.size(); ++i) {
    if (!profile.known[i]) continue;
    whole.mean_mps[0] += profile.speed_mps[i];
    whole.mean_mps[1] += profile.turn_mps[i];
    ++whole.count;
  }
  if (whole.count == 0) return whole;
  for (double& mean : whole.mean_mps) mean /= whole.count;
  for (std::size_t i = 0; i < profile.known.size(); ++i) {
    profile.speed_mps[i] -= whole.mean_mps[0];
    profile.turn_mps[i] -= whole.mean_mps[1];
    if (profile.known[i])
      whole.square += profile.speed_mps[i] * profile.speed_mps[i] + profile.turn_mps[i] * profile.turn_mps[i];
  }
  return whole;
}

struct MotionMatch::Sums {
  double count = 0;
  double wheel[2] = {}, truth[2] = {};                  // of the rates, their means subtracted
  double wheel_square = 0, truth_square = 0, both = 0;  // of both channels together
};

/// Bin i of the wheels falls between bins of truth, at first + slope i.
struct MotionMatch::Alignment {
  double first = 0, slope = 1;

  double of(double wheel_bin) const { return first + slope * wheel_bin; }
  /// The first bin of the wheels that is not before a bin of truth.
  double reaching(double truth_bin) const { return std::ceil((truth_bin - first) / slope); }
};

MotionMatch::Rows::Rows(const MotionProfile& profile)
    : speed(Eigen::ArrayXd::Map(profile.speed_mps.data(), std::ssize(profile.speed_mps))),
      turn(Eigen::ArrayXd::Map(profile.turn_mps.data(), std::ssize(profile.turn_mps))) {
  const Eigen::Index steps = std::max<Eigen::Index>(0, speed.size() - 1);
  speed_step = speed.tail(steps) - speed.head(steps);
  turn_step = turn.tail(steps) - turn.head(steps);
}

MotionMatch::MotionMatch(MotionProfile wheels, MotionProfile truth, double noise_mps)
    : wheels_(std::move(wheels)),
      truth_(std::move(truth)),
      noise_(noise_mps * noise_mps),
      all_wheels_(centred(wheels_)),
      all_truth_(centred(truth_)),
      wheel_rows_(wheels_),
      truth_rows_(truth_),
      index_(kLongestRow) {
  for (Eigen::Index i = 0; i < index_.size(); ++i) index_[i] = static_cast<double>(i);
  Eigen::Array3d before = Eigen::Array3d::Zero();
  for (std::size_t i = 0; i < wheels_.known.size(); ++i) {
    wheels_before_.push_back(before);
    const double speed = wheels_.speed_mps[i], turn = wheels_.turn_mps[i];
    before += Eigen::Array3d(speed, turn, speed * speed + turn * turn);
  }
  wheels_before_.push_back(before);
  for (std::size_t i = 0; i < truth_.known.size(); ++i) {
    if (!truth_.known[i]) continue;
    if (i == 0 || !truth_.known[i - 1]) stretches_.push_back({i, i});
    stretches_.back().end = i + 1;
  }
}

MotionMatch::Sums MotionMatch::sums(const ClockGuess& guess) const {
  Alignment alignment;
  alignment.slope = 1 / (1 + guess.skew);
  alignment.first =
      (guess.truth_s - truth_.first_s + (wheels_.first_s - guess.robot_s) * alignment.slope) / wheels_.bin_s;
  const double slip = alignment.slope - 1;
  const auto longest =
      static_cast<double>(std::min<Eigen::Index>(kLongestRow, truth_rows_.speed_step.size()));
  Sums sums;
  for (const Stretch& stretch : stretches_) {
    const double to = std::min(static_cast<double>(wheels_.known.size()),
                               alignment.reaching(static_cast<double>(stretch.end) - 1));
    // As long as the clocks run almost alike, many bins in a row lie equally many bins of truth ahead.
    for (double i = std::max(0.0, alignment.reaching(static_cast<double>(stretch.begin))); i < to;) {
      const double ahead = std::floor(alignment.of(i)) - i;
      double end = std::min(to, i + longest);
      if (slip > 0) end = std::min(end, std::ceil((ahead + 1 - alignment.first) / slip));
      if (slip < 0) end = std::min(end, std::floor((ahead - alignment.first) / slip) + 1);
      end = std::max(end, i + 1);  // whatever rounding makes of it
      add_row(alignment, i, end, sums);
      i = end;
    }
  }
  return sums;
}

/// Adds the bins from..to-1 of the wheels, all of which lie equally many bins of truth ahead.
void MotionMatch::add_row(const Alignment& alignment, double from, double to, Sums& sums) const {
  using Row = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kLongestRow, 1>;
  // Where a bin of the wheels meets one of truth, rounding may say that it lies just beyond the ends.
  const double last = static_cast<double>(truth_rows_.speed_step.size()) - (to - from);
  const double at = std::clamp(std::floor(alignment.of(from)), 0.0, last);
  const auto n = static_cast<Eigen::Index>(to - from);
  const auto w = static_cast<Eigen::Index>(from), k = static_cast<Eigen::Index>(at);
  const Row part = alignment.of(from) - at + (alignment.slope - 1) * index_.head(n);
  const Row speed = truth_rows_.speed.segment(k, n) + part * truth_rows_.speed_step.segment(k, n);
  const Row turn = truth_rows_.turn.segment(k, n) + part * truth_rows_.turn_step.segment(k, n);
  const Eigen::Array3d wheels =
      wheels_before_[static_cast<std::size_t>(to)] - wheels_before_[static_cast<std::size_t>(from)];
  sums.count += to - from;
  sums.wheel[0] += wheels[0];
  sums.wheel[1] += wheels[1];
  sums.wheel_square += wheels[2];
  sums.truth[0] += speed.sum();
  sums.truth[1] += turn.sum();
  sums.truth_square += (speed * speed + turn * turn).sum();
  sums.both += (wheel_rows_.speed.segment(w, n) * speed + wheel_rows_.turn.segment(w, n) * turn).sum();
}

Agreement MotionMatch::at(const ClockGuess& guess) const {
  const Sums s = sums(guess);
  if (s.count < 2) return {};
  double wheels = s.wheel_square, truth = s.truth_square, both = s.both;
  double plain_wheels = wheels, plain_truth = truth, plain_both = both;
  for (int i = 0; i < 2; ++i) {
    wheels -= s.wheel[i] * s.wheel[i] / s.count;
    truth -= s.truth[i] * s.truth[i] / s.count;
    both -= s.wheel[i] * s.truth[i] / s.count;
    const double a = all_wheels_.mean_mps[i], b = all_truth_.mean_mps[i];
    plain_wheels += a * (2 * s.wheel[i] + s.count * a);
    plain_truth += b * (2 * s.truth[i] + s.count * b);
    plain_both += a * s.truth[i] + b * s.wheel[i] + s.count * a * b;
  }
  const auto without_noise = [&](double square) {
    return std::max(square - s.count * noise_, kLeastMotion * s.count * noise_);
  };
  const double covered =
      std::max(part(plain_wheels, all_wheels_.motion()),
               part(without_noise(plain_truth), all_truth_.motion() - all_truth_.count * noise_));
  Agreement found;
  found.correlation = cosine(both, wheels, without_noise(truth)) * std::sqrt(covered);
  found.likeness = cosine(plain_both, plain_wheels, without_noise(plain_truth)) *
                   part(s.count, std::min(all_wheels_.count, all_truth_.count));
  const double raw = std::max(0.0, cosine(both, wheels, truth));
  found.unexplained = 1 - raw * raw * covered;
  found.overlap_s = s.count * wheels_.bin_s;
  return found;
}

}  // namespace astro::calibration
