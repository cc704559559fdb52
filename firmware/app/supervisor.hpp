#pragma once

#include <cstdint>

#include "common/params/parameter_set.hpp"
#include "common/safety/fault_latch.hpp"
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
  /// Raises what it finds; `powered`: the bridges are driving.
  void advance(const TickInput& input, bool plausible, bool powered, const Wheels& wheels,
               FaultLatch& faults);
  void reset();

 private:
  std::int32_t battery_low_mv_ = 0, battery_high_mv_ = 0, over_speed_umps_ = 0;
  Watch under_voltage_, over_voltage_, over_speed_, left_stall_, right_stall_;
};

}  // namespace astro
