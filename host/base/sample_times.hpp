#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"

/// What the times of samples tell of the clock and the link that gave them, in the order in which the samples came.
namespace astro {

/// What was mended of a stream's times. Values: the stream; then for clock_set_back and clock_set_on by how many seconds and
/// after how many seconds of the stream, for clock_set_often how many times, for bursts_evened the longest delay in seconds.
enum class TimesRemark { clock_set_back, clock_set_on, clock_set_often, bursts_evened };

/// Mends `times_ns`, and adds a remark for each thing that was done. `what` names the stream: "the wheels". Returns whether the
/// clock had been set back.
///   A clock that was set back in between, at most eight times: the samples after the fall are as many as those before it in
///   the time that then exists twice. What follows is set on by the fall and a period, as if no sample were missing. Samples
///   that merely came out of order are left so, and so are two recordings of which one follows the other.
///   Bursts, of samples that waited for a link: each has the time at which it came. Samples of a steady clock are never late
///   by less than the least delay near them; so their number gives their times, but for a common delay. Without bursts
///   nothing is changed.
/// Falls of up to three periods cannot be told from samples out of order.
bool mend_times(std::vector<std::int64_t>& times_ns, const std::string& what, std::vector<Remark>& remarks);

/// The first sample of a second recording that follows a first one: nearly all times before it exist again after it.
std::optional<std::size_t> second_recording(const std::vector<std::int64_t>& times_ns);

/// The times of samples with a `time_ns`, and back.
template <class Sample>
std::vector<std::int64_t> times_of(const std::vector<Sample>& samples) {
  std::vector<std::int64_t> times_ns;
  times_ns.reserve(samples.size());
  for (const Sample& sample : samples) times_ns.push_back(sample.time_ns);
  return times_ns;
}

template <class Sample>
void set_times(std::vector<Sample>& samples, const std::vector<std::int64_t>& times_ns) {
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].time_ns = times_ns[i];
}

}  // namespace astro
