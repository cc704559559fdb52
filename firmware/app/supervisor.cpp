#include "firmware/app/supervisor.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr std::uint32_t kUnderVoltage_ticks = 100;
constexpr std::uint32_t kOverVoltage_ticks = 20;
constexpr std::uint32_t kOverSpeed_ticks = 20;
constexpr std::uint32_t kStall_ticks = 1000;
constexpr std::int32_t kStallDuty = 32767 / 3;
constexpr std::int32_t kStallSpeed_umps = 2'000;

}  // namespace

void Supervisor::configure(const ParameterSet& set) {
  battery_low_mv_ = set.get(Param::battery_low);
  const std::int32_t high_mv = set.get(Param::battery_high);
  battery_high_mv_ = high_mv != 0 ? high_mv : INT32_MAX;
  over_speed_umps_ = set.get(Param::over_speed);
}

void Supervisor::reset() {
  for (Watch* watch : {&under_voltage_, &over_voltage_, &over_speed_, &left_stall_, &right_stall_})
    watch->reset();
}

std::uint32_t Supervisor::advance(const TickInput& input, bool plausible, bool powered,
                                  const Wheels& wheels) {
  std::uint32_t found = plausible ? 0 : bit(Fault::encoder);
  const auto found_if = [&](bool condition, Fault fault) { found |= condition ? bit(fault) : 0; };
  const WheelSpeeds& speeds = wheels.speeds();
  found_if(over_voltage_.advance(input.battery_mv > battery_high_mv_, kOverVoltage_ticks),
           Fault::over_voltage);
  found_if(over_speed_.advance(
               exceeds(speeds.left_umps, over_speed_umps_) || exceeds(speeds.right_umps, over_speed_umps_),
               kOverSpeed_ticks),
           Fault::over_speed);
  watched_ = true;
  if (!powered) {
    under_voltage_.reset();
    left_stall_.reset();
    right_stall_.reset();
    return found;
  }
  const hal::Duty& duty = wheels.forward_duty();
  const auto stands = [](std::int16_t drive, std::int32_t speed_umps) {
    return exceeds(drive, kStallDuty) && !exceeds(speed_umps, kStallSpeed_umps);
  };
  found_if(input.driver_fault, Fault::driver);
  found_if(under_voltage_.advance(input.battery_mv < battery_low_mv_, kUnderVoltage_ticks),
           Fault::under_voltage);
  found_if(left_stall_.advance(stands(duty.left, speeds.left_umps), kStall_ticks), Fault::stall);
  found_if(right_stall_.advance(stands(duty.right, speeds.right_umps), kStall_ticks), Fault::stall);
  return found;
}

}  // namespace astro
