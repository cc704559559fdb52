#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/sample_times.hpp"

namespace astro::importing {

/// Takes back the steps of the clock that stamped messages, with a remark for each, and returns whether there were any. Where it
/// was set, two stamps are further apart or nearer than all others, and from there on the messages reach the recorder by as
/// much sooner or later after their stamps. Messages that are lost or late are none. A clock that was set more than eight times
/// is not used: the messages then have the times of their arrival.
///
/// `arrivals_ns`: when each message reached the recorder, by the recorder's clock.
/// Steps below 0.06 s are not told from delays.
bool take_clock_steps_back(std::vector<std::int64_t>& stamps_ns, std::span<const std::int64_t> arrivals_ns,
                           const std::string& what, std::vector<Remark>& remarks);

/// Throws astro::Error if the times of messages, in the order in which they came, are those of two recordings. `file` holds
/// them.
void refuse_second_recording(const std::vector<std::int64_t>& times_ns, const std::string& file,
                             const std::string& what);

/// Mends the times of samples that are in the order in which they came (sample_times.hpp), sorts them by their time_ns, and
/// drops all but the first of those with equal times, with a remark for each. Returns whether a step of their clock was taken
/// back. `what` names the samples, for example "poses of /tracker", and `file` where they are. `arrivals_ns` are those of the
/// samples if their times are stamps, otherwise empty. Throws astro::Error of two recordings in one, which sorting would mix;
/// a clock that was set back soon after the beginning looks like them, unless the arrivals show it.
template <class Sample>
bool order_by_time(std::vector<Sample>& samples, std::span<const std::int64_t> arrivals_ns,
                   const std::string& file, const std::string& what, std::vector<Remark>& remarks) {
  std::vector<std::int64_t> times_ns = times_of(samples);
  bool stepped = take_clock_steps_back(times_ns, arrivals_ns, what, remarks);
  refuse_second_recording(times_ns, file, what);
  stepped = mend_times(times_ns, what, remarks) || stepped;
  set_times(samples, times_ns);
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
  return stepped;
}

}  // namespace astro::importing
