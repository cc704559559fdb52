#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "host/base/microseconds.hpp"

namespace astro::live {

/// The clocks of this computer, or of a test.
struct HostClock {
  std::function<microseconds()> steady;  // the one by which the robot's transport tells the time
  std::function<std::int64_t()> utc_ns;  // since 1970

  static HostClock of_system();
};

/// Converts times of the steady clock to time since 1970. The offset between the two clocks is measured once a second, so
/// that stamps follow the system's clock when it is slewed but do not jitter with every reading. It is measured at once if
/// the system's clock was set.
///
/// If it simulates, as nodes with a true `use_sim_time` do, it returns the last time that the simulation has published,
/// whatever time is asked for, because it is not known how fast the simulation runs.
class UtcMap {
 public:
  explicit UtcMap(HostClock clock) : clock_(std::move(clock)) {}

  std::int64_t utc_ns(std::int64_t steady_us);
  std::int64_t now_ns() const { return simulated_ ? told_ns_ : clock_.utc_ns(); }
  microseconds steady() const { return clock_.steady(); }

  /// Also forgets the simulated time.
  void simulate(bool on) {
    simulated_ = on;
    told_ns_ = 0;
  }
  bool simulated() const { return simulated_; }
  void tell(std::int64_t simulated_ns) { told_ns_ = simulated_ns; }
  /// False while it simulates and the simulation has not published its time, which is 0 until then.
  bool known() const { return !simulated_ || told_ns_ != 0; }

 private:
  bool was_set(microseconds now) const;
  void measure(microseconds now);

  HostClock clock_;
  std::optional<microseconds> measured_;
  std::int64_t offset_ns_ = 0;
  bool simulated_ = false;
  std::int64_t told_ns_ = 0;
};

}  // namespace astro::live
