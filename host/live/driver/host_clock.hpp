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

/// Times of the steady clock as time since 1970. The offset between both is measured once a second, so that stamps follow the
/// system's clock when it is slewed, and do not tremble with every reading; and at once when that clock was set.
///
/// Or, as nodes do whose `use_sim_time` is true, the time that a simulation told last, whatever the moment: how fast its time runs
/// is not known.
class UtcMap {
 public:
  explicit UtcMap(HostClock clock) : clock_(std::move(clock)) {}

  std::int64_t utc_ns(std::int64_t steady_us);
  std::int64_t now_ns() const { return simulated_ ? told_ns_ : clock_.utc_ns(); }
  microseconds steady() const { return clock_.steady(); }

  /// Forgets what was told.
  void simulate(bool on) {
    simulated_ = on;
    told_ns_ = 0;
  }
  bool simulated() const { return simulated_; }
  void tell(std::int64_t simulated_ns) { told_ns_ = simulated_ns; }
  /// Not before a simulation has told its time, which is 0 until then.
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
