#include "host/calibration/clock_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/calibration/wheel_path.hpp"

namespace astro::calibration {
namespace {

constexpr double kFinestBin_s = 0.05;  // of both motions
constexpr double kMostBins = 2000;     // else the bins grow: trying every offset takes their square
constexpr double kLongestGap_s = 1;
constexpr double kNearby_s = 1;
constexpr double kGoodEnough = 0.95;
constexpr double kMostSkew = 0.05, kSkewStep = 0.0025, kFineSkewStep = 0.0005;

/// Speed and turn rate at equal steps of time, both in m/s; the turn rate is that of a wheel.
struct Rate {
  double speed_mps = 0, turn_mps = 0;
  bool known = true;

  Rate operator+(const Rate& other) const {
    return {speed_mps + other.speed_mps, turn_mps + other.turn_mps, known};
  }
};

struct Profile {
  double first_s = 0;
  std::vector<Rate> bins;
};

// Half of the time over which a speed is taken.
double half_window_s(double bin_s) { return std::max(0.1, bin_s); }

bool has_headings(const Trajectory& run) {
  return std::any_of(run.truth.begin(), run.truth.end(),
                     [](const BodySample& sample) { return std::isfinite(sample.theta_rad); });
}

Profile wheel_profile(const Trajectory& run, bool headings, double bin_s) {
  const double half_s = half_window_s(bin_s);
  const WheelPath path(run.wheels);
  Profile profile{run.wheels.front().time_s, {}};
  for (double t = profile.first_s; t <= run.wheels.back().time_s; t += bin_s) {
    const WheelState a = path.at(t - half_s), b = path.at(t + half_s);
    const double left = b.left_m - a.left_m, right = b.right_m - a.right_m;
    profile.bins.push_back({std::abs(left + right) / 2 / (2 * half_s),
                            headings ? std::abs(right - left) / 2 / (2 * half_s) : 0, true});
  }
  return profile;
}

// The pose of the body at a time between two samples that are near enough.
std::optional<BodySample> body_at(const std::vector<BodySample>& truth, double time_s, std::size_t& hint) {
  while (hint + 2 < truth.size() && truth[hint + 1].time_s < time_s) ++hint;
  while (hint > 0 && truth[hint].time_s > time_s) --hint;
  const BodySample &a = truth[hint], &b = truth[hint + 1];
  const double span_s = b.time_s - a.time_s;
  if (time_s < a.time_s || time_s > b.time_s || span_s > kLongestGap_s || span_s <= 0) return {};
  const double s = (time_s - a.time_s) / span_s;
  return BodySample{time_s, a.x_m + s * (b.x_m - a.x_m), a.y_m + s * (b.y_m - a.y_m),
                    a.theta_rad + s * std::remainder(b.theta_rad - a.theta_rad, 2 * std::numbers::pi)};
}

Profile truth_profile(const Trajectory& run, double wheelbase_m, double bin_s) {
  const double half_s = half_window_s(bin_s);
  Profile profile{run.truth.front().time_s, {}};
  std::size_t from = 0, to = 0;
  for (double t = profile.first_s; t <= run.truth.back().time_s; t += bin_s) {
    const auto a = body_at(run.truth, t - half_s, from), b = body_at(run.truth, t + half_s, to);
    Rate motion{0, 0, a && b};
    if (motion.known) {
      motion.speed_mps = std::hypot(b->x_m - a->x_m, b->y_m - a->y_m) / (2 * half_s);
      const double turn_rad = std::remainder(b->theta_rad - a->theta_rad, 2 * std::numbers::pi);
      motion.turn_mps = std::isfinite(turn_rad) ? std::abs(turn_rad) * wheelbase_m / 2 / (2 * half_s) : 0;
    }
    profile.bins.push_back(motion);
  }
  return profile;
}

Rate mean_taken_off(Profile& profile) {
  Rate mean{0, 0, true};
  double count = 0;
  for (const Rate& bin : profile.bins) {
    if (!bin.known) continue;
    mean.speed_mps += bin.speed_mps;
    mean.turn_mps += bin.turn_mps;
    ++count;
  }
  for (Rate& bin : profile.bins) {
    bin.speed_mps -= mean.speed_mps / count;
    bin.turn_mps -= mean.turn_mps / count;
  }
  return {mean.speed_mps / count, mean.turn_mps / count, true};
}

class Search {
 public:
  Search(const Trajectory& run, double wheelbase_m, double bin_s)
      : bin_s_(bin_s),
        wheels_(wheel_profile(run, has_headings(run), bin_s)),
        truth_(truth_profile(run, wheelbase_m, bin_s)) {
    wheel_mean_ = mean_taken_off(wheels_);
    truth_mean_ = mean_taken_off(truth_);
    middle_s_ = wheels_.first_s + bin_s_ * static_cast<double>(wheels_.bins.size() - 1) / 2;
  }

  double bin_s() const { return bin_s_; }
  double truth_duration_s() const { return bin_s_ * static_cast<double>(truth_.bins.size()); }
  double wheel_duration_s() const { return bin_s_ * static_cast<double>(wheels_.bins.size()); }
  /// The offset at which the middles of both meet.
  double middle_offset_s() const { return middle_s_ - truth_.first_s - truth_duration_s() / 2; }

  double correlation(double offset_s, double skew) const { return product(offset_s, skew, {}, {}); }
  double likeness(double offset_s, double skew) const {
    return product(offset_s, skew, wheel_mean_, truth_mean_);
  }

  ClockFit best(double from_s, double to_s, double step_s, double skew) const {
    ClockFit best{0, skew, -1};
    for (double offset_s = from_s; offset_s <= to_s; offset_s += step_s) {
      const double found = correlation(offset_s, skew);
      if (found > best.correlation) best = {offset_s, skew, found};
    }
    return best;
  }

  /// The top of the parabola through the neighbours.
  ClockFit refined(ClockFit fit, double step_s) const {
    const double a = correlation(fit.offset_s - step_s, fit.skew), b = fit.correlation;
    const double c = correlation(fit.offset_s + step_s, fit.skew);
    const double bend = a - 2 * b + c;
    if (bend < 0) fit.offset_s += std::clamp(step_s / 2 * (a - c) / bend, -step_s, step_s);
    return fit;
  }

 private:
  /// Cosine between the two motions, each with this much added.
  double product(double offset_s, double skew, const Rate& wheel_mean, const Rate& truth_mean) const {
    const double truth_middle_s = middle_s_ - offset_s;
    double both = 0, wheels = 0, truth = 0;
    for (std::size_t i = 0; i < wheels_.bins.size(); ++i) {
      const Rate a = wheels_.bins[i] + wheel_mean;
      wheels += a.speed_mps * a.speed_mps + a.turn_mps * a.turn_mps;
      const double u = wheels_.first_s + bin_s_ * static_cast<double>(i) - middle_s_;
      const double bin = (truth_middle_s + u / (1 + skew) - truth_.first_s) / bin_s_;
      if (!(bin >= 0 && bin < static_cast<double>(truth_.bins.size() - 1))) continue;
      const auto k = static_cast<std::size_t>(bin);
      const Rate &from = truth_.bins[k], &to = truth_.bins[k + 1];
      if (!from.known || !to.known) continue;
      const double s = bin - static_cast<double>(k);
      const double speed = truth_mean.speed_mps + from.speed_mps + s * (to.speed_mps - from.speed_mps);
      const double turn = truth_mean.turn_mps + from.turn_mps + s * (to.turn_mps - from.turn_mps);
      both += a.speed_mps * speed + a.turn_mps * turn;
      truth += speed * speed + turn * turn;
    }
    return wheels > 0 && truth > 0 ? both / std::sqrt(wheels * truth) : -1;
  }

  double bin_s_;
  Profile wheels_, truth_;
  Rate wheel_mean_, truth_mean_;
  double middle_s_ = 0;
};

ClockFit search_everywhere(const Search& search, std::optional<double> skew) {
  const double reach_s = (search.truth_duration_s() + search.wheel_duration_s()) / 2;
  const double middle_s = search.middle_offset_s(), step_s = 2 * search.bin_s();
  ClockFit best{0, 0, -1};
  const auto try_skew = [&](double candidate, double around_s, double within_s) {
    const ClockFit found = search.best(around_s - within_s, around_s + within_s, step_s, candidate);
    if (found.correlation > best.correlation) best = found;
  };
  if (skew) {
    try_skew(*skew, middle_s, reach_s);
    return best;
  }
  for (double s = -kMostSkew; s <= kMostSkew; s += kSkewStep) try_skew(s, middle_s, reach_s);
  const ClockFit coarse = best;
  for (double s = coarse.skew - kSkewStep; s <= coarse.skew + kSkewStep; s += kFineSkewStep)
    try_skew(s, coarse.offset_s, 5 * step_s);
  return best;
}

}  // namespace

ClockFit search_clock(const Trajectory& run, double wheelbase_m, std::optional<double> skew) {
  const Search fine(run, wheelbase_m, kFinestBin_s);
  ClockFit best = fine.best(-kNearby_s, kNearby_s, kFinestBin_s, skew.value_or(0));
  if (best.correlation < kGoodEnough) {
    const double longer_s = std::max(fine.wheel_duration_s(), fine.truth_duration_s());
    const Search coarse(run, wheelbase_m, std::max(kFinestBin_s, longer_s / kMostBins));
    const ClockFit anywhere = search_everywhere(coarse, skew);
    const double around_s = 2 * coarse.bin_s();
    const ClockFit there =
        fine.best(anywhere.offset_s - around_s, anywhere.offset_s + around_s, kFinestBin_s, anywhere.skew);
    if (there.correlation > best.correlation) best = there;
  }
  best = fine.refined(best, kFinestBin_s);
  best.likeness = fine.likeness(best.offset_s, best.skew);
  return best;
}

}  // namespace astro::calibration
