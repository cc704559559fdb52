#pragma once

#include <cstdint>
#include <utility>

#include "common/params/parameter_set.hpp"
#include "common/safety/fault.hpp"
#include "common/safety/watch.hpp"
#include "firmware/app/wheels.hpp"

namespace astro {

/// Looks at every tick for what must stop the robot, whatever it is doing.
///
///   driver           the bridge reports over-current or over-temperature: at once
///   under_voltage    supply below battery_low for 100 ms (a start-up dip is shorter); 0 switches it off
///   over_voltage     supply above battery_high for 20 ms; 0 switches it off
///   over_speed       a wheel faster than over_speed for 20 ms
///   stall            more than a third of the voltage on a wheel that has not moved for 1 s
///   encoder          more counts in a tick than a motor can turn: at once
class Supervisor {
 public:
  void configure(const ParameterSet& set);
  /// The faults of this tick, as a mask of their bits. `plausible`: what the encoders showed can be;
  /// `powered`: the bridges are driving.
  std::uint32_t advance(const TickInput& input, bool plausible, bool powered, const Wheels& wheels);
  void reset();
  /// True once after advance() came to its end.
  bool take_watched() { return std::exchange(watched_, false); }

 private:
  std::int32_t battery_low_mv_ = 0, battery_high_mv_ = 0, over_speed_umps_ = 0;
  bool watched_ = false;
  Watch under_voltage_, over_voltage_, over_speed_, left_stall_, right_stall_;
};

}  // namespace astro
