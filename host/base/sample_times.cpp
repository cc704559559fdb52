#include "host/base/sample_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <utility>

#include "host/base/order_statistics.hpp"

namespace astro {
namespace {

using Times = std::vector<std::int64_t>;

constexpr std::size_t kFewest = 20;
constexpr double kLongestDelay_ns = 1e9;

bool can_be_mended(const Times& times) {
  if (times.size() < kFewest) return false;
  const auto [least, most] = std::ranges::minmax(times);
  return least >= -kMostTime_ns && most <= kMostTime_ns;
}

double seconds(double ns) { return 1e-9 * ns; }

/// The period of a steady clock behind times of which some are late: the mean of the middle half over long stretches, in which
/// delays hardly count, and of which a pause is in few.
double steady_period_ns(const Times& times) {
  constexpr std::size_t kMostStretches = 10'000;  // so that a long file needs no memory for them
  const std::size_t stretch = std::clamp<std::size_t>(times.size() / 8, 5, 2'000);
  std::vector<double> periods;
  for (std::size_t i = stretch; i < times.size(); i += 1 + times.size() / kMostStretches)
    periods.push_back(static_cast<double>(times[i] - times[i - stretch]) / static_cast<double>(stretch));
  std::ranges::sort(periods);
  const std::size_t quarter = periods.size() / 4;
  double sum = 0;
  for (std::size_t i = quarter; i < periods.size() - quarter; ++i) sum += periods[i];
  return sum / static_cast<double>(periods.size() - 2 * quarter);
}

/// The median time between samples, or the steady period where they come in bursts.
double usual_step_ns(const Times& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i)
    steps.push_back(static_cast<double>(times[i] - times[i - 1]));
  const double steady = steady_period_ns(times), median = median_of(std::move(steps));
  return median > steady / 3 ? median : steady;
}

/// How many samples about a fall of the times have one that exists twice.
struct Repeated {
  double before = 0, after = 0;
};

Repeated repeated_at(const Times& times, std::size_t at) {
  Repeated repeated;
  for (std::size_t i = at; i-- > 0 && times[i] >= times[at] && (i + 1 == at || times[i] <= times[i + 1]);)
    ++repeated.before;
  for (std::size_t i = at;
       i < times.size() && times[i] < times[at - 1] && (i == at || times[i] >= times[i - 1]); ++i)
    ++repeated.after;
  return repeated;
}

/// Where the clock was set back.
struct SetBacks {
  std::vector<ClockSetting> settings;
  std::optional<std::size_t> begins_again;  // instead: the first sample of another recording
};

/// A fall counts if the samples about it are as many before as after it as a clock gives in that time. Where nearly all samples
/// so far exist again after it, another recording follows.
SetBacks set_backs_of(const Times& times) {
  constexpr double kShortestPeriods = 3, kMost = 0.8, kNearlyAll = 0.9;
  SetBacks found;
  if (std::ranges::is_sorted(times)) return found;
  const double period_ns = usual_step_ns(times);
  if (!(period_ns > 0)) return found;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const std::int64_t fall_ns = times[i - 1] - times[i];
    if (static_cast<double>(fall_ns) < kShortestPeriods * period_ns) continue;
    const Repeated repeated = repeated_at(times, i);
    const double wanted = kMost * static_cast<double>(fall_ns) / period_ns - 1;
    if (repeated.before < wanted || repeated.after < std::min<double>(wanted, kFewest)) continue;
    if (repeated.before > kNearlyAll * static_cast<double>(i)) {
      found.begins_again = i;
      return found;
    }
    if (repeated.after < wanted) continue;
    found.settings.push_back({i, -(fall_ns + std::llround(period_ns))});
  }
  return found;
}

/// Whether many samples come right after the one before, and some long after it.
bool comes_in_bursts(const Times& times, double period_ns) {
  constexpr double kAtOnce = 0.1, kManyAtOnce = 0.15, kLate = 2.5, kSomeLate = 0.005;
  double at_once = 0, late = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const auto step_ns = static_cast<double>(times[i] - times[i - 1]);
    at_once += step_ns < kAtOnce * period_ns ? 1 : 0;
    late += step_ns > kLate * period_ns ? 1 : 0;
  }
  const auto n = static_cast<double>(times.size());
  return at_once > kManyAtOnce * n && late > kSomeLate * n;
}

/// The least of each value and those that follow it within a window.
std::vector<double> least_ahead(const std::vector<double>& values, std::size_t window) {
  std::vector<double> least(values.size());
  std::deque<std::size_t> rising;  // what may become the least
  for (std::size_t i = values.size(); i-- > 0;) {
    while (!rising.empty() && values[rising.back()] >= values[i]) rising.pop_back();
    rising.push_back(i);
    while (rising.front() > i + window) rising.pop_front();
    least[i] = values[rising.front()];
  }
  return least;
}

/// The times of a steady clock of this period whose samples are never early, and how late the latest sample is.
std::pair<Times, double> evened(const Times& times, double period_ns) {
  std::vector<double> late_ns;
  for (std::size_t i = 0; i < times.size(); ++i)
    late_ns.push_back(static_cast<double>(times[i] - times[0]) - period_ns * static_cast<double>(i));
  const std::vector<double> least =
      least_ahead(late_ns, static_cast<std::size_t>(std::ceil(kLongestDelay_ns / period_ns)));
  const auto least_step_ns = static_cast<std::int64_t>(0.1 * period_ns);  // so that none repeats a time
  Times even;
  double longest_ns = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    longest_ns = std::max(longest_ns, late_ns[i] - least[i]);
    const std::int64_t time_ns = times[0] + std::llround(period_ns * static_cast<double>(i) + least[i]);
    even.push_back(even.empty() ? time_ns : std::max(time_ns, even.back() + least_step_ns));
  }
  return {std::move(even), longest_ns};
}

void even_out(Times& times, const std::string& what, std::vector<Remark>& remarks) {
  if (!std::ranges::is_sorted(times)) return;
  const double period_ns = steady_period_ns(times);
  if (!(period_ns > 0) || !comes_in_bursts(times, period_ns)) return;
  // Times without most of their delays give the period better than those with them.
  auto [even, longest_ns] = evened(times, steady_period_ns(evened(times, period_ns).first));
  if (longest_ns > kLongestDelay_ns) return;
  times = std::move(even);
  const std::string most = fmt::format("{:.2f}", seconds(longest_ns));
  remarks.push_back(
      {fmt::format("{} come in bursts, up to {} s late: their times were evened out", what, most),
       TimesRemark::bursts_evened,
       {what, most}});
}

Remark why_set(const ClockSetting& setting, double after_ns, const std::string& what,
               const std::string& how_known) {
  const bool on = setting.by_ns > 0;
  const std::string by = fmt::format("{:.2f}", std::abs(seconds(static_cast<double>(setting.by_ns)))),
                    at = fmt::format("{:.1f}", seconds(after_ns));
  return {fmt::format("the clock of {} was set {} by {} s at {} s{}: what follows was set {} by as much",
                      what, on ? "on" : "back", by, at, how_known, on ? "back" : "on"),
          on ? TimesRemark::clock_set_on : TimesRemark::clock_set_back,
          {what, by, at}};
}

}  // namespace

bool take_back(std::span<const ClockSetting> settings, const std::string& what, const std::string& how_known,
               std::vector<std::int64_t>& times_ns, std::vector<Remark>& remarks) {
  if (settings.size() > kMostClockSettings) return false;
  std::int64_t late_ns = 0;
  for (const ClockSetting& setting : settings) {
    late_ns += setting.by_ns;
    if (std::abs(late_ns) >= kMostTime_ns) return false;
  }
  late_ns = 0;
  for (std::size_t k = 0; k < settings.size(); ++k) {
    const std::size_t at = settings[k].at;
    remarks.push_back(
        why_set(settings[k], static_cast<double>(times_ns[at - 1] - times_ns.front()), what, how_known));
    late_ns += settings[k].by_ns;
    const std::size_t end = k + 1 < settings.size() ? settings[k + 1].at : times_ns.size();
    for (std::size_t i = at; i < end; ++i) times_ns[i] -= late_ns;
  }
  return !settings.empty();
}

bool mend_times(std::vector<std::int64_t>& times_ns, const std::string& what, std::vector<Remark>& remarks) {
  if (!can_be_mended(times_ns)) return false;
  const SetBacks found = set_backs_of(times_ns);
  const bool stepped = !found.begins_again && take_back(found.settings, what, "", times_ns, remarks);
  even_out(times_ns, what, remarks);
  return stepped;
}

std::optional<std::size_t> second_recording(const std::vector<std::int64_t>& times_ns) {
  return can_be_mended(times_ns) ? set_backs_of(times_ns).begins_again : std::nullopt;
}

}  // namespace astro
