#include "firmware/app/supervisor.hpp"

namespace astro {
namespace {

constexpr std::uint32_t kUnderVoltage_ticks = 100;
constexpr std::uint32_t kOverVoltage_ticks = 20;
constexpr std::uint32_t kOverSpeed_ticks = 20;
constexpr std::uint32_t kStall_ticks = 1000;
constexpr std::int32_t kStallDuty = 32767 / 3;
constexpr std::int32_t kStallSpeed_umps = 2'000;

constexpr bool exceeds(std::int32_t value, std::int32_t limit) { return value > limit || value < -limit; }

}  // namespace

void Supervisor::configure(const ParameterSet& set) {
  battery_low_mv_ = set.get(Param::battery_low);
  battery_high_mv_ = set.get(Param::battery_high);
  over_speed_umps_ = set.get(Param::over_speed);
}

void Supervisor::reset() {
  for (Watch* watch : {&under_voltage_, &over_voltage_, &over_speed_, &left_stall_, &right_stall_})
    watch->reset();
}

void Supervisor::advance(const TickInput& input, bool plausible, bool powered, const Wheels& wheels,
                         FaultLatch& faults) {
  const auto raise_if = [&](bool condition, Fault fault) {
    if (condition) faults.raise(fault, input.now_us);
  };
  const WheelSpeeds speeds = wheels.speeds();
  const hal::Duty duty = wheels.forward_duty();
  raise_if(!plausible, Fault::encoder);
  raise_if(powered && input.driver_fault, Fault::driver);
  raise_if(under_voltage_.advance(powered && input.battery_mv < battery_low_mv_, kUnderVoltage_ticks),
           Fault::under_voltage);
  raise_if(
      over_voltage_.advance(battery_high_mv_ != 0 && input.battery_mv > battery_high_mv_, kOverVoltage_ticks),
      Fault::over_voltage);
  raise_if(over_speed_.advance(
               exceeds(speeds.left_umps, over_speed_umps_) || exceeds(speeds.right_umps, over_speed_umps_),
               kOverSpeed_ticks),
           Fault::over_speed);
  raise_if(left_stall_.advance(
               powered && exceeds(duty.left, kStallDuty) && !exceeds(speeds.left_umps, kStallSpeed_umps),
               kStall_ticks),
           Fault::stall);
  raise_if(right_stall_.advance(
               powered && exceeds(duty.right, kStallDuty) && !exceeds(speeds.right_umps, kStallSpeed_umps),
               kStall_ticks),
           Fault::stall);
}

}  // namespace astro
