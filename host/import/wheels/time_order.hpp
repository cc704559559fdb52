#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/sample_times.hpp"

namespace astro::importing {

/// Mends the times of samples that are in the order in which they came (sample_times.hpp), sorts them by their time_ns, and
/// drops all but the first of those with equal times, with a remark for each. `what` names the samples, for example "poses of
/// /tracker".
template <class Sample>
void order_by_time(std::vector<Sample>& samples, const std::string& what, std::vector<Remark>& remarks) {
  mend_times_of(samples, what, remarks);
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
