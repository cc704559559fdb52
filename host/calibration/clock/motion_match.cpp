#include "host/calibration/clock/motion_match.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace astro::calibration {
namespace {

// In variances of the noise: a motion of truth below this is not distinguishable from noise.
constexpr double kLeastMotion = 3;

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

MotionMatch::MotionMatch(MotionProfile wheels, MotionProfile truth, double noise_mps)
    : wheels_(std::move(wheels)), truth_(std::move(truth)), noise_(noise_mps * noise_mps) {
  all_wheels_ = centred(wheels_);
  all_truth_ = centred(truth_);
}

MotionMatch::Sums MotionMatch::sums(const ClockGuess& guess) const {
  // Bin of truth = first + slope * bin of wheels.
  const double slope = 1 / (1 + guess.skew);
  const double first =
      (guess.truth_s - truth_.first_s + (wheels_.first_s - guess.robot_s) * slope) / wheels_.bin_s;
  const double last = static_cast<double>(truth_.known.size()) - 1;
  const double from = std::max(0.0, std::ceil(-first / slope));
  const double to = std::min(static_cast<double>(wheels_.known.size()), std::ceil((last - first) / slope));
  Sums sums;
  for (double i = from; i < to; ++i) {
    const double bin = first + slope * i;
    const auto k = static_cast<std::size_t>(bin), w = static_cast<std::size_t>(i);
    if (k + 1 >= truth_.known.size() || !truth_.known[k] || !truth_.known[k + 1]) continue;
    const double s = bin - static_cast<double>(k);
    const double a = wheels_.speed_mps[w], c = wheels_.turn_mps[w];
    const double b = truth_.speed_mps[k] + s * (truth_.speed_mps[k + 1] - truth_.speed_mps[k]);
    const double d = truth_.turn_mps[k] + s * (truth_.turn_mps[k + 1] - truth_.turn_mps[k]);
    ++sums.count;
    sums.wheel[0] += a;
    sums.wheel[1] += c;
    sums.truth[0] += b;
    sums.truth[1] += d;
    sums.wheel_square += a * a + c * c;
    sums.truth_square += b * b + d * d;
    sums.both += a * b + c * d;
  }
  return sums;
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
