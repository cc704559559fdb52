#include "host/calibration/motion/recorded_motion.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibration/motion/tracker_noise.hpp"

namespace astro::calibration {
namespace {

// The noise, relative to the variation of the wheels' speed, that does not hide this variation.
constexpr double kWantedNoise = 0.2;
constexpr double kLongestHalfWindow_s = 0.5;
constexpr double kBeyond_s =
    5;  // of standing still before and after the wheels' samples: longer than any window
// Bins fine enough for the variation of the wheels' speed.
constexpr double kGlance_s = 0.1;
constexpr double kFinestBin_s = 0.05;

double standard_deviation_mps(const MotionProfile& profile) {
  double n = 0, speed = 0, turn = 0, square = 0;
  for (std::size_t i = 0; i < profile.known.size(); ++i) {
    const double a = profile.speed_mps[i], b = profile.turn_mps[i];
    ++n;
    speed += a;
    turn += b;
    square += a * a + b * b;
  }
  return n > 0 ? std::sqrt(std::max(0.0, square / n - (speed * speed + turn * turn) / (n * n))) : 0;
}

}  // namespace

RecordedMotion::RecordedMotion(const Trajectory& run, double wheelbase_m, double lever_m)
    : run_(run),
      headings_(mostly_headings(run.truth)),
      radius_m_(headings_ ? wheelbase_m / 2 : 0),
      wheel_path_(wheel_body(run.wheels, wheelbase_m, lever_m, kBeyond_s)),
      truth_path_(run.truth, headings_) {
  SecondDifferences differences;
  differences.add(run.truth);
  sigma_m_ = std::hypot(differences.sigma_xy_m(), differences.sigma_theta_rad() * radius_m_);
  truth_rate_hz_ = static_cast<double>(run.truth.size()) / std::max(truth_span_s(), 1e-3);
  choose_window();
}

void RecordedMotion::choose_window() {
  const double wanted_mps =
      kWantedNoise * standard_deviation_mps(wheels(std::max(kGlance_s, finest_bin_s())));
  if (noise_mps(window_) <= wanted_mps) return;
  // Of n = rate * width samples each, means over neighbouring widths differ by sqrt(2 / n) sigma.
  const double width_s = std::cbrt(2 / truth_rate_hz_ * std::pow(sigma_m_ / std::max(wanted_mps, 1e-6), 2));
  window_ = {std::clamp(width_s / 2, window_.half_s, kLongestHalfWindow_s), true};
}

double RecordedMotion::finest_bin_s() const {
  return std::max(kFinestBin_s, (truth_span_s() + wheel_span_s()) / kMostSteps);
}

double RecordedMotion::noise_mps(const Window& window) const {
  const double width_s = 2 * window.half_s;
  const double samples = window.averaged ? std::max(1.0, truth_rate_hz_ * width_s) : 1;
  return std::sqrt(2 / samples) * sigma_m_ / width_s;
}

Window RecordedMotion::window_for(double bin_s) const {
  return bin_s > window_.half_s ? Window{std::min(bin_s, kBeyond_s / 2), window_.averaged} : window_;
}

MotionProfile RecordedMotion::wheels(double bin_s) const {
  return profile_of(wheel_path_, run_.wheels.front().time_s, run_.wheels.back().time_s, bin_s,
                    window_for(bin_s), radius_m_);
}

MotionProfile RecordedMotion::truth(double bin_s) const {
  return profile_of(truth_path_, run_.truth.front().time_s, run_.truth.back().time_s, bin_s,
                    window_for(bin_s), radius_m_);
}

MotionMatch RecordedMotion::match(double bin_s) const {
  return {wheels(bin_s), truth(bin_s), noise_mps(window_for(bin_s))};
}

}  // namespace astro::calibration
