#include "host/live/driver/host_clock.hpp"

#include <chrono>
#include <cstdlib>

namespace astro::live {

using std::chrono::duration_cast;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;
using std::chrono::system_clock;

HostClock HostClock::of_system() {
  return {[] { return duration_cast<microseconds>(steady_clock::now().time_since_epoch()); },
          [] { return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count(); }};
}

std::int64_t UtcMap::utc_ns(std::int64_t steady_us) {
  if (simulated_) return told_ns_;
  const microseconds now = clock_.steady();
  if (!measured_ || now - *measured_ >= std::chrono::seconds(1) || was_set(now)) measure(now);
  return steady_us * 1000 + offset_ns_;
}

/// If the program is interrupted between the two readings, this returns true by mistake; the offset is then
/// only measured once more.
bool UtcMap::was_set(microseconds now) const {
  constexpr std::int64_t kStep_ns = 50'000'000;
  return std::abs(clock_.utc_ns() - now.count() * 1000 - offset_ns_) > kStep_ns;
}

/// Uses the fastest of a few readings, because an interruption between the two clocks can only add time.
void UtcMap::measure(microseconds now) {
  constexpr int kReadings = 5;
  microseconds best = microseconds::max();
  for (int i = 0; i < kReadings; ++i) {
    const microseconds before = clock_.steady();
    const std::int64_t utc_ns = clock_.utc_ns();
    const microseconds took = clock_.steady() - before;
    if (took >= best) continue;
    best = took;
    offset_ns_ = utc_ns - (before + took / 2).count() * 1000;
  }
  measured_ = now;
}

}  // namespace astro::live
