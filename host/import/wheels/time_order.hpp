#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/sample_times.hpp"
#include "host/import/wheels/stamp_count.hpp"

namespace astro::importing {

/// `times_ns`: of messages in the order in which they came.
inline void refuse_second_recording(const std::vector<std::int64_t>& times_ns, const std::string& what) {
  const auto second = second_recording(times_ns);
  if (!second) return;
  const std::string after =
      fmt::format("{:.1f}", 1e-9 * static_cast<double>(times_ns[*second - 1] - times_ns.front()));
  throw Error(fmt::format("{}: after {} s their stamps begin again: two recordings in one; cut it there",
                          what, after),
              StampProblem::begin_again, {what, after});
}

/// Mends the times of samples that are in the order in which they came (sample_times.hpp), sorts them by their time_ns, and
/// drops all but the first of those with equal times, with a remark for each. `what` names the samples, for example "poses of
/// /tracker". Throws astro::Error of two recordings in one, which sorting would mix.
template <class Sample>
void order_by_time(std::vector<Sample>& samples, const std::string& what, std::vector<Remark>& remarks) {
  refuse_second_recording(mend_times_of(samples, what, remarks), what);
  if (!std::ranges::is_sorted(samples, {}, &Sample::time_ns)) {
    std::stable_sort(samples.begin(), samples.end(),
                     [](const Sample& a, const Sample& b) { return a.time_ns < b.time_ns; });
    remarks.push_back({what + " were recorded out of order; they were sorted by time"});
  }
  const auto repeated = std::unique(samples.begin(), samples.end(),
                                    [](const Sample& a, const Sample& b) { return a.time_ns == b.time_ns; });
  if (repeated != samples.end())
    remarks.push_back(
        {what + ": " + std::to_string(samples.end() - repeated) + " repeat a time and were left out"});
  samples.erase(repeated, samples.end());
}

}  // namespace astro::importing
