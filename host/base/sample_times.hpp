#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"

/// What the times of samples tell of the clock and the link that gave them, in the order in which the samples came.
namespace astro {

/// What was mended of a stream's times. Values: the stream; then for clock_set_back and clock_set_on by how many seconds and
/// after how many seconds of the stream, for clock_set_often how many times, for bursts_evened the longest delay in seconds.
enum class TimesRemark { clock_set_back, clock_set_on, clock_set_often, bursts_evened };

/// A file may hold any times. Sums and differences of a few times up to this one are numbers.
inline constexpr std::int64_t kMostTime_ns = std::numeric_limits<std::int64_t>::max() / 4;

/// A moment at which the clock of a stream was set.
struct ClockSetting {
  std::size_t at = 0;      // the first sample after it
  std::int64_t by_ns = 0;  // above 0: on; below 0: back
};

/// The most settings of one stream that are taken back.
inline constexpr std::size_t kMostClockSettings = 8;

/// Sets the times after each setting by as much the other way, with a remark for each, and returns whether there were any. Changes
/// nothing if there are more than kMostClockSettings, or if they add up to more than kMostTime_ns.
///
/// `settings`: in the order of the samples. `how_known`: a clause for the remarks, as ", as their arrival shows"; may be empty.
bool take_back(std::span<const ClockSetting> settings, const std::string& what, const std::string& how_known,
               std::vector<std::int64_t>& times_ns, std::vector<Remark>& remarks);

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
