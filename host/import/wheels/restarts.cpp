#include "host/import/wheels/restarts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"
#include "host/import/wheels/counter_wraps.hpp"

namespace astro::importing {
namespace {

using Samples = std::vector<WheelSample>;

constexpr std::size_t kFewest = 20;

/// The longer step of both wheels.
double step_of(const WheelSample& from, const WheelSample& to) {
  return std::max(std::abs(to.left - from.left), std::abs(to.right - from.right));
}

/// A long step: one in twenty is longer, so that a few jumps do not count.
double long_step(const Samples& samples) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) steps.push_back(step_of(samples[i - 1], samples[i]));
  return at_rank(steps, steps.size() - 1 - steps.size() / 20);
}

bool is_zero(const WheelSample& sample) { return sample.left == 0 && sample.right == 0; }

/// Whether a counter or an angle is at the end of its range there, so that it begins again by itself.
bool is_at_an_end(double value, double near) {
  for (const double end : {256.0, 4'096.0, 65'536.0, 16'777'216.0, 4'294'967'296.0, 2 * std::numbers::pi})
    if (std::abs(std::abs(value) - end) <= near) return true;
  return false;
}

bool goes_on(const Samples& samples, std::size_t i, double most) {
  return i + 1 >= samples.size() || step_of(samples[i], samples[i + 1]) <= most;
}

}  // namespace

void join_restarts(WheelTrack& track, const std::string& name) {
  constexpr double kFar = 10, kUsual = 2, kLate = 2.5;  // of a long step; of the usual period
  Samples& samples = track.samples;
  if (samples.size() < kFewest) return;
  const double step = long_step(samples);
  if (!(step > 0)) return;
  if (is_zero(samples[0]) && step_of(samples[0], samples[1]) > kFar * step &&
      goes_on(samples, 1, kUsual * step)) {
    samples.erase(samples.begin());
    track.remarks.push_back({name + ": the first sample is zero and far from the next one; it was left out",
                             WheelRemark::first_left_out,
                             {name}});
  }
  std::vector<std::int64_t> periods;
  for (std::size_t i = 1; i < samples.size(); ++i)
    periods.push_back(samples[i].time_ns - samples[i - 1].time_ns);
  const double usual_ns = static_cast<double>(median_of(std::move(periods)));
  WheelSample offset;  // what was counted before the last restart
  WheelSample before = samples.front();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    WheelSample& now = samples[i];
    const WheelSample counted = now;
    const bool begins =
        std::abs(counted.left) <= kUsual * step && std::abs(counted.right) <= kUsual * step &&
        step_of(before, counted) > kFar * step && goes_on(samples, i, kUsual * step) &&
        !(is_at_an_end(before.left, kUsual * step) || is_at_an_end(before.right, kUsual * step));
    if (begins) {
      const std::string time_s = fmt::format("{:.3f}", 1e-9 * static_cast<double>(now.time_ns));
      const double gap_ns = static_cast<double>(now.time_ns - samples[i - 1].time_ns);
      if (gap_ns > kLate * usual_ns)
        throw Error(fmt::format("{}: the counters begin again at {} s after {:.2f} s without samples, in "
                                "which nobody knows how "
                                "far the wheels went; cut it there",
                                name, time_s, 1e-9 * gap_ns),
                    CounterProblem::begins_again, {name, time_s});
      const WheelSample& joined = samples[i - 1];
      const auto pace = [&](double WheelSample::*wheel) {
        const bool has_next = i + 1 < samples.size();
        const double past = i > 1 ? joined.*wheel - samples[i - 2].*wheel : 0;
        const double next = has_next ? samples[i + 1].*wheel - counted.*wheel : 0;
        const double mean = (past + next) / std::max(1, (i > 1 ? 1 : 0) + (has_next ? 1 : 0));
        const bool whole = past == std::round(past) && counted.*wheel == std::round(counted.*wheel);
        return whole ? std::round(mean) : mean;  // counts stay whole: their unit is told by that
      };
      offset.left = joined.left + pace(&WheelSample::left) - counted.left;
      offset.right = joined.right + pace(&WheelSample::right) - counted.right;
      track.remarks.push_back({name + ": the counters begin again at " + time_s +
                                   " s; the wheels are taken to have gone on at their pace",
                               WheelRemark::restart_joined,
                               {name, time_s}});
    }
    before = counted;
    now.left += offset.left;
    now.right += offset.right;
  }
}

}  // namespace astro::importing
