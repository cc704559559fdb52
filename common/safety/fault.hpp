#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace astro {

/// What makes the robot stop by itself. A fault is latched until it is cleared and means zero duty. The
/// values are sent and stored, so they are append only.
enum class Fault : std::uint8_t {
  none,
  command_timeout,  // no velocity command for longer than the parameter allows
  link_lost,        // no good frame from the host that drives
  driver,           // the H-bridge reports over-current or over-temperature
  under_voltage,    // battery below its lower limit
  over_voltage,     // battery above its upper limit
  over_speed,       // a wheel turns faster than the limits allow
  stall,            // duty without motion
  encoder,          // counts that the motor cannot have made
  tick_overrun,     // the control tick did not come on time
  parameters,       // the parameters that were committed last are lost or refused
  flash,            // flash did not read back what was written
  emergency_stop,   // a host demanded it
  runaway,          // a wheel turns against its voltage, or faster than the voltage can turn it
  watchdog,         // the firmware hung or crashed, and was restarted
  stop_timeout,     // the wheels did not come to rest although they were told to
  gyro_slip,        // the robot turned without its wheels, and gyro_slip_stops is 1
};

inline constexpr std::array<std::string_view, 17> kFaultNames{
    "none",           "command_timeout", "link_lost", "driver",       "under_voltage", "over_voltage",
    "over_speed",     "stall",           "encoder",   "tick_overrun", "parameters",    "flash",
    "emergency_stop", "runaway",         "watchdog",  "stop_timeout", "gyro_slip"};
static_assert(kFaultNames.size() == static_cast<std::size_t>(Fault::gyro_slip) + 1);

constexpr std::span<const std::string_view> names(Fault) { return kFaultNames; }

/// For people and logs; "?" for a value that this version does not know.
constexpr std::string_view name(Fault fault) {
  const auto index = static_cast<std::size_t>(fault);
  return index < kFaultNames.size() ? kFaultNames[index] : "?";
}

/// The fault's bit in a mask of latched faults: bit n is fault n. `none` has no bit.
constexpr std::uint32_t bit(Fault fault) {
  return fault == Fault::none ? 0U : std::uint32_t{1} << static_cast<unsigned>(fault);
}

}  // namespace astro
