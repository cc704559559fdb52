#include "host/robot/client/fault_help.hpp"

#include <array>
#include <cstddef>

namespace astro::robot {
namespace {

constexpr std::array<std::string_view, kFaultNames.size()> kFaultHelp{
    "",
    "no velocity came for longer than the parameter command_timeout: its sender ended or hung",
    "the host fell silent during a drive: its program ended or the cable came off",
    "the motor driver reports too much current or heat: let it cool, look for a blocked wheel or a short",
    "the supply fell below battery_low: charge the battery",
    "the supply rose above battery_high: check battery and regulator",
    "a wheel turned faster than over_speed: check encoder_polarity and motor_polarity",
    "voltage on a motor and no motion: look for a blocked wheel or a loose motor or encoder lead",
    "counts that no motor can produce: check the encoder's leads",
    "the control tick came late while driving: report it, the firmware should never do that",
    "the parameters that were saved last cannot be read, and older ones or the defaults are in force: load "
    "yours again, or commit these",
    "the flash did not keep what was written: the last set stays in force, the part may be worn",
    "an emergency stop was requested",
    "a wheel turned against its voltage: a motor or an encoder has the wrong polarity",
    "the firmware hung or ran wild and was restarted: report it, it should never do that",
    "the wheels still turned a second after their set point became zero: look for a slope or a load that the "
    "motors do not hold, a wrong polarity or gear ratio, or weak gains",
    "the gyro saw a turn that the wheels did not make, and the parameter gyro_slip_stops is 1: somebody "
    "pushed "
    "the robot, it slipped, or gyro_axis names the wrong axis or sign",
};

}  // namespace

std::string_view fault_help(Fault fault) {
  const auto index = static_cast<std::size_t>(fault);
  return index < kFaultHelp.size() ? kFaultHelp[index] : "";
}

}  // namespace astro::robot
