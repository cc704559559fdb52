#include "host/import/bags/time_order.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <optional>

#include "host/base/order_statistics.hpp"
#include "host/import/bags/stamp_count.hpp"

namespace astro::importing {
namespace {

using Times = std::span<const std::int64_t>;

double seconds_of(std::int64_t time_ns) { return 1e-9 * static_cast<double>(time_ns); }

std::int64_t usual_period_ns(Times times_ns) {
  std::vector<std::int64_t> steps_ns;
  for (std::size_t i = 1; i < times_ns.size(); ++i)
    if (times_ns[i] > times_ns[i - 1]) steps_ns.push_back(times_ns[i] - times_ns[i - 1]);
  return steps_ns.empty() ? 0 : median_of(std::move(steps_ns));
}

/// The least delay of the messages from one on, forward or backward, that came within the time of a stall. A stall delays all
/// of them only if it lasts as long.
std::optional<std::int64_t> least_delay_ns(Times stamps_ns, Times arrivals_ns, std::size_t from, int step) {
  constexpr std::int64_t kLongestStall_ns = 2'000'000'000;
  constexpr int kEnough = 5, kMost = 20'000;
  std::optional<std::int64_t> least;
  int looked_at = 0;
  for (std::size_t i = from; i < stamps_ns.size() && looked_at < kMost; i += static_cast<std::size_t>(step)) {
    if (std::abs(arrivals_ns[i] - arrivals_ns[from]) > kLongestStall_ns && looked_at >= kEnough) break;
    const std::int64_t delay_ns = arrivals_ns[i] - stamps_ns[i];
    least = least ? std::min(*least, delay_ns) : delay_ns;
    ++looked_at;
  }
  return looked_at >= kEnough ? least : std::nullopt;
}

std::vector<ClockSetting> steps_of(Times stamps_ns, Times arrivals_ns) {
  constexpr std::int64_t kSmallest_ns = 60'000'000, kAlike_ns = 30'000'000, kShortestPause_ns = 500'000'000;
  constexpr std::size_t kMostLeaps =
      1000;  // a clock has no more; it also bounds the time that a hostile bag takes
  const std::int64_t usual_ns = usual_period_ns(stamps_ns),
                     smallest_ns = std::max(kSmallest_ns, usual_ns / 2);
  std::vector<ClockSetting> steps;
  std::size_t leaps = 0;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i) {
    const std::int64_t by_ns = stamps_ns[i] - stamps_ns[i - 1] - usual_ns;
    if (std::abs(by_ns) < smallest_ns) continue;
    if (++leaps > kMostLeaps) return {};
    const auto before_ns = least_delay_ns(stamps_ns, arrivals_ns, i - 1, -1),
               after_ns = least_delay_ns(stamps_ns, arrivals_ns, i, 1);
    if (!before_ns || !after_ns) continue;
    // In floating point, because a clock may be set from 1970 to today.
    const double off_ns =
        static_cast<double>(*before_ns) - static_cast<double>(*after_ns) - static_cast<double>(by_ns);
    // A second recording that was started within seconds is no step back.
    const std::int64_t most_ns = by_ns < 0 ? kShortestPause_ns : std::numeric_limits<std::int64_t>::max();
    if (std::abs(off_ns) < static_cast<double>(std::max(kAlike_ns, std::min(std::abs(by_ns) / 5, most_ns))))
      steps.push_back({i, by_ns});
  }
  return steps;
}

/// Whether all times are possible, and the messages are in the order of their arrival.
bool can_be_compared(Times stamps_ns, Times arrivals_ns) {
  const auto is_possible = [](std::int64_t time_ns) { return std::abs(time_ns) < kMostTime_ns; };
  return stamps_ns.size() == arrivals_ns.size() && std::ranges::is_sorted(arrivals_ns) &&
         std::ranges::all_of(stamps_ns, is_possible) && std::ranges::all_of(arrivals_ns, is_possible);
}

}  // namespace

bool take_clock_steps_back(std::vector<std::int64_t>& stamps_ns, std::span<const std::int64_t> arrivals_ns,
                           const std::string& what, std::vector<Remark>& remarks) {
  if (!can_be_compared(stamps_ns, arrivals_ns)) return false;
  const std::vector<ClockSetting> steps = steps_of(stamps_ns, arrivals_ns);
  if (steps.size() > kMostClockSettings) {
    const std::string times = std::to_string(steps.size());
    remarks.push_back(
        {fmt::format("the clock of {} was set {} times, as their arrival shows: their times are "
                     "those of their arrival",
                     what, times),
         TimesRemark::clock_set_often,
         {what, times}});
    stamps_ns.assign(arrivals_ns.begin(), arrivals_ns.end());
    return true;
  }
  return take_back(steps, what, ", as their arrival shows", stamps_ns, remarks);
}

void refuse_second_recording(const std::vector<std::int64_t>& times_ns, const std::string& file,
                             const std::string& what) {
  const auto second = second_recording(times_ns);
  if (!second) return;
  const std::string after = fmt::format("{:.1f}", seconds_of(times_ns[*second - 1] - times_ns.front()));
  throw Error(fmt::format("{}: {}: after {} s their stamps begin again: two recordings in one; cut it there",
                          file, what, after),
              StampProblem::begin_again, {file, what, after});
}

}  // namespace astro::importing
