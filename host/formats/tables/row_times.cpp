#include "host/formats/tables/row_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "host/base/order_statistics.hpp"

namespace astro::tables {
namespace {

/// Whether times that rows share are those of a clock with too few digits: nearly all different ones are the same step apart.
bool share_a_step(std::span<const std::int64_t> times_ns) {
  constexpr double kNearlyAll = 0.9;
  std::vector<std::int64_t> steps_ns;
  for (std::size_t i = 1; i < times_ns.size(); ++i)
    if (times_ns[i] != times_ns[i - 1]) steps_ns.push_back(times_ns[i] - times_ns[i - 1]);
  if (steps_ns.empty()) return true;
  const std::int64_t step_ns = median_of(std::vector(steps_ns));
  const auto alike = std::ranges::count_if(
      steps_ns, [&](std::int64_t one) { return std::abs(one - step_ns) <= step_ns / 100; });
  return static_cast<double>(alike) >= kNearlyAll * static_cast<double>(steps_ns.size());
}

}  // namespace

std::optional<SpreadTimes> spread_times(std::vector<std::int64_t> times_ns) {
  constexpr std::size_t kFewestTimes = 5;
  constexpr double kPart = 0.2, kNearlyAll = 0.9, kLeast_ns = 1000;
  std::vector<std::size_t> begins;  // of the rows with one time
  for (std::size_t i = 0; i < times_ns.size(); ++i)
    if (i == 0 || times_ns[i] != times_ns[i - 1]) begins.push_back(i);
  if (begins.size() < kFewestTimes) return std::nullopt;
  const std::size_t last = begins.size() - 1;
  std::vector<std::int64_t> steps_ns;
  for (std::size_t i = 0; i < last; ++i) steps_ns.push_back(times_ns[begins[i + 1]] - times_ns[begins[i]]);
  const auto step_ns = static_cast<double>(median_of(std::vector(steps_ns)));
  const double usual = static_cast<double>(begins[last] - begins[1]) / static_cast<double>(last - 1);
  if (step_ns < kLeast_ns * usual) return std::nullopt;
  std::size_t even = 0;
  for (std::size_t i = 1; i < last; ++i)
    even += std::abs(static_cast<double>(begins[i + 1] - begins[i]) - usual) <= std::max(1.0, kPart * usual);
  if (static_cast<double>(even) < kNearlyAll * static_cast<double>(last - 1)) return std::nullopt;
  begins.push_back(times_ns.size());
  for (std::size_t i = 0; i <= last; ++i) {
    const double width_ns = i == last ? step_ns : std::min(step_ns, static_cast<double>(steps_ns[i]));
    const auto rows = static_cast<double>(begins[i + 1] - begins[i]);
    const double places = i == 0 || i == last ? std::max(rows, usual) : rows;
    const double skipped = i == 0 ? places - rows : 0;
    const std::int64_t from_ns = times_ns[begins[i]];
    for (std::size_t row = begins[i]; row < begins[i + 1]; ++row) {
      const double place = skipped + static_cast<double>(row - begins[i]) + 0.5;
      const std::int64_t at_ns = from_ns + std::llround(width_ns * place / places);
      times_ns[row] = row == 0 ? at_ns : std::max(at_ns, times_ns[row - 1] + 1);
    }
  }
  return SpreadTimes{std::move(times_ns), 1e-9 * step_ns, usual};
}

std::string TimeFall::text() const {
  return fmt::format("the time falls from {:.3f} s to {:.3f} s", from_s, to_s);
}

void RowTimes::take(std::int64_t time_ns, int line, bool changed) {
  const bool repeats = last_ns_ == time_ns;
  if (last_ns_ && time_ns < *last_ns_) falls_.emplace_back(rows_, line);
  changed_ += changed ? 1 : 0;
  changed_repeated_ += repeats && changed ? 1 : 0;
  last_ns_ = time_ns;
  ++rows_;
}

bool RowTimes::few_repeat() const {
  constexpr std::size_t kFew = 5, kOneOf = 10;
  return changed_repeated_ <= std::max(kFew, changed_ / kOneOf);
}

std::string RowTimes::percent_repeated() const {
  return std::to_string(changed_ == 0 ? 0 : (100 * changed_repeated_ + changed_ / 2) / changed_);
}

SettledTimes RowTimes::settle_times(std::vector<std::int64_t>& times_ns, const std::string& what,
                                    std::vector<Remark>& remarks) const {
  SettledTimes settled;
  if (falls_.empty() && !few_repeat() && share_a_step(times_ns)) {
    settled.spread = spread_times(times_ns);
    settled.too_coarse = !settled.spread;
    if (settled.spread) times_ns = std::move(settled.spread->times_ns);
    return settled;
  }
  mend_times(times_ns, what, remarks);
  for (const auto& [row, line] : falls_)
    if (times_ns[row] < times_ns[row - 1]) {
      settled.fall = {line, 1e-9 * static_cast<double>(times_ns[row - 1]),
                      1e-9 * static_cast<double>(times_ns[row])};
      return settled;
    }
  settled.too_coarse = !few_repeat() && std::ranges::adjacent_find(times_ns) != times_ns.end();
  return settled;
}

}  // namespace astro::tables
