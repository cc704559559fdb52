#include "host/truth/floor/lost_tracking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "host/base/order_statistics.hpp"
#include "host/base/text/degrees.hpp"

namespace astro::truth {
namespace {

using Samples = std::vector<TrackedPose>;
using Values = std::array<double, 7>;

Values values_of(const Pose3& p) { return {p.x_m, p.y_m, p.z_m, p.qx, p.qy, p.qz, p.qw}; }

double distance_m(const Pose3& a, const Pose3& b) {
  return std::sqrt((a.x_m - b.x_m) * (a.x_m - b.x_m) + (a.y_m - b.y_m) * (a.y_m - b.y_m) +
                   (a.z_m - b.z_m) * (a.z_m - b.z_m));
}

double angle_rad(const Pose3& a, const Pose3& b) {
  const double dot = std::abs(a.qx * b.qx + a.qy * b.qy + a.qz * b.qz + a.qw * b.qw);
  return 2 * std::acos(std::min(1.0, dot));
}

double seconds_between(const TrackedPose& a, const TrackedPose& b) {
  return 1e-9 * static_cast<double>(b.time_ns - a.time_ns);
}

/// The last digit of each value: the smallest change between neighbours. Changes below a nanometre do not count, because the
/// conversion of units rounds.
Values last_digits(const Samples& samples) {
  Values digits;
  digits.fill(std::numeric_limits<double>::infinity());
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (!samples[i].valid || !samples[i - 1].valid) continue;
    const Values a = values_of(samples[i - 1].pose), b = values_of(samples[i].pose);
    for (std::size_t k = 0; k < a.size(); ++k) {
      const double change = std::abs(b[k] - a[k]);
      if (change > 1e-9) digits[k] = std::min(digits[k], change);
    }
  }
  return digits;
}

/// Whether a value changes by more than one last digit, because rounding alone can change it by one.
bool changes_beyond(const Values& digits, const Pose3& from, const Pose3& to) {
  const Values a = values_of(from), b = values_of(to);
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::abs(b[k] - a[k]) > 1.5 * digits[k]) return true;
  }
  return false;
}

bool moves(const TrackedPose& from, const TrackedPose& to) {
  constexpr double kSlowest_mps = 0.02, kSlowest_radps = radians(10);
  const double time_s = seconds_between(from, to);
  return distance_m(from.pose, to.pose) > kSlowest_mps * time_s ||
         angle_rad(from.pose, to.pose) > kSlowest_radps * time_s;
}

/// Whether samples first + 1 to last, which repeat `first`, were not measured.
bool is_held(const Samples& samples, std::size_t first, std::size_t last, const Values& digits, bool noisy) {
  const std::size_t before = first >= 3 ? first - 3 : 0;
  const bool before_valid = first > 0 && samples[first - 1].valid && samples[before].valid;
  if (last + 1 >= samples.size())
    return noisy && last - first >= 3 && before_valid && moves(samples[before], samples[first]);
  const TrackedPose& after = samples[last + 1];
  if (!after.valid) return before_valid && moves(samples[before], samples[first]);
  const TrackedPose& start = before_valid ? samples[first - 1] : samples[first];
  return changes_beyond(digits, samples[first].pose, after.pose) && moves(start, after);
}

std::size_t mark_repeated(Samples& samples, const Values& digits, bool noisy) {
  std::size_t marked = 0;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    std::size_t last = i;
    while (samples[i].valid && last + 1 < samples.size() && samples[last + 1].valid &&
           samples[last + 1].pose == samples[i].pose)
      ++last;
    if (last == i) continue;
    if (is_held(samples, i, last, digits, noisy)) {
      for (std::size_t k = i + 1; k <= last; ++k) samples[k].valid = false;
      marked += last - i;
    }
    i = last;
  }
  return marked;
}

/// Marks samples at the origin without a rotation, which trackers send for a body that they do not see.
std::size_t mark_at_zero(Samples& samples) {
  constexpr double kElsewhere_m = 0.05;
  const auto at_origin = [](const TrackedPose& s) {
    const Pose3& p = s.pose;
    return s.valid && p.x_m == 0 && p.y_m == 0 && p.z_m == 0 && p.qx == 0 && p.qy == 0 && p.qz == 0;
  };
  std::size_t marked = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::size_t end = i;
    while (end < samples.size() && at_origin(samples[end])) ++end;
    if (end == i) continue;
    const auto elsewhere = [&](std::size_t at) {
      return at < samples.size() && samples[at].valid &&
             distance_m(samples[at].pose, samples[i].pose) > kElsewhere_m;
    };
    // i - 1 wraps round to an index beyond the end where there is no sample before.
    if (elsewhere(i - 1) || elsewhere(end)) {
      for (std::size_t k = i; k < end; ++k) samples[k].valid = false;
      marked += end - i;
    }
    i = end;
  }
  return marked;
}

/// The second difference of a sample and its neighbours in last digits, per coordinate, which is 0 on a straight line;
/// infinite if one of the three is invalid or they are not evenly spaced in time.
std::array<double, 3> bend(const Samples& samples, std::size_t i, const Values& digits) {
  const TrackedPose &a = samples[i - 1], &b = samples[i], &c = samples[i + 1];
  const std::int64_t uneven = (c.time_ns - b.time_ns) - (b.time_ns - a.time_ns);
  const bool apart = std::abs(uneven) > (c.time_ns - a.time_ns) / 20;
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (!a.valid || !b.valid || !c.valid || apart) return {kUnknown, kUnknown, kUnknown};
  const Values va = values_of(a.pose), vb = values_of(b.pose), vc = values_of(c.pose);
  std::array<double, 3> bends{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::isfinite(digits[k])) bends[k] = (va[k] - 2 * vb[k] + vc[k]) / digits[k];
  }
  return bends;
}

/// Decides whether the bends come from the tracker's noise. Bends of white noise change their sign from sample to sample in
/// 73 % of the cases, those of a smooth motion hardly ever.
class NoiseCheck {
 public:
  void take(const std::array<double, 3>& bends) {
    constexpr double kNoise = 8;
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::isfinite(bends[k]) && std::abs(bends[k]) > kNoise && std::abs(last_[k]) > kNoise) {
        ++pairs_;
        changes_ += (bends[k] < 0) != (last_[k] < 0);
      }
      last_[k] = std::isfinite(bends[k]) ? bends[k] : 0;
    }
    ++samples_;
  }
  bool is_noisy() const { return 2 * pairs_ > samples_ && 2 * changes_ > pairs_; }

 private:
  std::array<double, 3> last_{};
  std::size_t pairs_ = 0, changes_ = 0, samples_ = 0;
};

bool is_straight(const std::array<double, 3>& bends) {
  constexpr double kRounding = 2.05;
  return std::all_of(bends.begin(), bends.end(), [](double b) { return std::abs(b) <= kRounding; });
}

bool is_noisy(const Samples& samples, const Values& digits) {
  NoiseCheck noise;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) noise.take(bend(samples, i, digits));
  return noise.is_noisy();
}

std::size_t mark_filled(Samples& samples, const Values& digits) {
  constexpr std::size_t kShortest = 8;
  std::vector<bool> straight(samples.size());
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) straight[i] = is_straight(bend(samples, i, digits));
  std::size_t marked = 0;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    std::size_t end = i;
    while (end + 1 < samples.size() && straight[end]) ++end;
    if (end - i >= kShortest && !(samples[i].pose == samples[end - 1].pose)) {
      for (std::size_t k = i; k < end; ++k) samples[k].valid = false;
      marked += end - i;
    }
    i = std::max(i, end);
  }
  return marked;
}

/// Marks samples between two jumps, away from a place and back to it.
std::size_t mark_jumped(Samples& samples) {
  constexpr double kFar = 6, kLeast_m = 0.03, kLongest_s = 1,
                   kBack = 1.5;  // in steps that hardly any exceeds
  constexpr std::size_t kFewest = 20;
  std::vector<std::size_t> valid;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples[i].valid) valid.push_back(i);
  if (valid.size() < kFewest) return 0;
  const auto step_m = [&](std::size_t from, std::size_t to) {
    return distance_m(samples[valid[from]].pose, samples[valid[to]].pose);
  };
  std::vector<double> steps;
  for (std::size_t i = 1; i < valid.size(); ++i) steps.push_back(step_m(i - 1, i));
  const double usual = at_rank(steps, steps.size() - 1 - steps.size() / 10);
  const double far = std::max(kLeast_m, kFar * usual);
  std::size_t marked = 0;
  for (std::size_t i = 1; i < valid.size(); ++i) {
    if (steps[i - 1] < far) continue;
    for (std::size_t k = i + 1; k < valid.size(); ++k) {
      if (seconds_between(samples[valid[i - 1]], samples[valid[k]]) > kLongest_s) break;
      if (steps[k - 1] < far) continue;
      if (step_m(i - 1, k) > kBack * usual * static_cast<double>(k - i + 1) + kLeast_m / 3) continue;
      for (std::size_t at = i; at < k; ++at) samples[valid[at]].valid = false;
      marked += k - i;
      i = k;
      break;
    }
  }
  return marked;
}

}  // namespace

LostSamples mark_lost(BodyTrack& track) {
  LostSamples lost;
  Samples& samples = track.samples;
  lost.absent = static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [](const TrackedPose& s) { return !s.valid; }));
  const Values digits = last_digits(samples);
  const bool ends_only = samples.size() == 2;  // a person who measures them puts the origin at the start
  if (!ends_only) lost.at_zero = mark_at_zero(samples);
  const bool noisy = is_noisy(samples, digits);
  lost.repeated = mark_repeated(samples, digits, noisy);
  if (noisy) lost.filled = mark_filled(samples, digits);
  lost.jumped = mark_jumped(samples);
  return lost;
}

}  // namespace astro::truth
